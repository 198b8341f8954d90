// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_run.h"
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace fastlio
{
namespace
{
constexpr int kDecimals = 2;
// Beyond every error and proxy; the states rank in their order.
constexpr double kStateStep = 1e9;
const char* const kMeasures[] = {"proxy", "slip", "residual"};

/** The outcomes on a recording, as columns of numbers. */
struct Columns
{
  std::vector<double> measure, ape, rpe;
};

/** Runs that were not lost, and have the numbers. */
Columns trackedOnly(const std::vector<RunOutcome>& outcomes, const std::string& name)
{
  Columns columns;
  for (const RunOutcome& outcome : outcomes)
  {
    const auto measure = outcome.measure(name);
    const auto ape = outcome.measure("ape");
    const auto rpe = outcome.measure("rpe");
    if (outcome.state >= RunState::Lost || !measure || !ape || !rpe) continue;
    columns.measure.push_back(*measure);
    columns.ape.push_back(*ape);
    columns.rpe.push_back(*rpe);
  }
  return columns;
}

/** All runs, in the order of the tuner: by state, then by the measure; what has no error ranks last
 * in truth. */
Columns allRuns(const std::vector<RunOutcome>& outcomes, const std::string& name)
{
  Columns columns;
  for (const RunOutcome& outcome : outcomes)
  {
    const double state = kStateStep * static_cast<double>(outcome.state);
    columns.measure.push_back(state + outcome.measure(name).value_or(0.5 * kStateStep));
    columns.ape.push_back(outcome.measure("ape").value_or(kStateStep));
    columns.rpe.push_back(outcome.measure("rpe").value_or(kStateStep));
  }
  return columns;
}

/** Sums over recordings. */
struct Means
{
  double tracked_ape = 0.0, tracked_rpe = 0.0, all_ape = 0.0, all_rpe = 0.0;
};

std::string rowOf(const Means& correlations, double scale)
{
  std::string text;
  for (const double value :
       {correlations.tracked_ape, correlations.tracked_rpe, correlations.all_ape,
        correlations.all_rpe})
    text += "| " + fixedText(value * scale, kDecimals) + " ";
  return text;
}

Means correlationsOf(const std::vector<RunOutcome>& outcomes, const std::string& name)
{
  const Columns tracked = trackedOnly(outcomes, name);
  const Columns all = allRuns(outcomes, name);
  return {
      rankCorrelation(tracked.measure, tracked.ape), rankCorrelation(tracked.measure, tracked.rpe),
      rankCorrelation(all.measure, all.ape), rankCorrelation(all.measure, all.rpe)};
}

void add(Means& sum, const Means& one)
{
  sum.tracked_ape += one.tracked_ape;
  sum.tracked_rpe += one.tracked_rpe;
  sum.all_ape += one.all_ape;
  sum.all_rpe += one.all_rpe;
}
}  // namespace

void rankProxy(const TuneCommand& command)
{
  const SearchInputs inputs = readInputs(command);
  Evaluator evaluator(command, inputs);
  const std::vector<Trial> sets = knownSets(command, inputs);
  (void)evaluator.run(sets, recordingsWithout(inputs, inputs.recordings.size()));
  std::cout << "Rank correlation (Spearman) with the true error over " << sets.size()
            << " parameter sets\n\n| measure | recording | tracked runs | their APE | their RPE | "
               "APE of all | RPE of all |\n|---|---|--:|--:|--:|--:|--:|\n";
  for (const std::string name : kMeasures)
  {
    Means sum;
    for (std::size_t r = 0; r < inputs.recordings.size(); ++r)
    {
      std::vector<RunOutcome> outcomes;
      for (const Trial& trial : sets)
        outcomes.push_back(evaluator.outcome(trial, r));
      const Means correlations = correlationsOf(outcomes, name);
      add(sum, correlations);
      std::cout << "| " << name << " | "
                << printable(std::filesystem::path(inputs.recordings[r].path).stem().string())
                << " | " << trackedOnly(outcomes, name).ape.size() << ' '
                << rowOf(correlations, 1.0) << "|\n";
    }
    std::cout << "| " << name << " | **mean** | "
              << rowOf(sum, 1.0 / static_cast<double>(inputs.recordings.size())) << "|\n";
  }
}
}  // namespace fastlio
