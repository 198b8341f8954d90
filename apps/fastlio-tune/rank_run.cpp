// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_run.h"
#include <fastlio/math/statistics.h>
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
const char* const kMeasures[] = {"proxy", "slip", "position_std", "residual"};

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

struct Correlations
{
  std::vector<double> ape, rpe;  //!< one per recording
};

double meanOf(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
    sum += value;
  return sum / static_cast<double>(values.size());
}

std::string rowOf(
    const std::string& measure, const std::string& name, const std::string& runs, double ape,
    double rpe)
{
  return "| " + measure + " | " + name + " | " + runs + " | " + fixedText(ape, kDecimals) + " | " +
         fixedText(rpe, kDecimals) + " |\n";
}

/** Prints a row per recording, and the mean and median of all. */
void printRows(
    const std::string& measure, const SearchInputs& inputs,
    const std::vector<std::vector<RunOutcome>>& outcomes)
{
  Correlations correlations;
  for (std::size_t r = 0; r < inputs.recordings.size(); ++r)
  {
    const Columns columns = trackedOnly(outcomes[r], measure);
    correlations.ape.push_back(rankCorrelation(columns.measure, columns.ape));
    correlations.rpe.push_back(rankCorrelation(columns.measure, columns.rpe));
    std::cout << rowOf(
        measure, printable(std::filesystem::path(inputs.recordings[r].path).stem().string()),
        std::to_string(columns.ape.size()), correlations.ape.back(), correlations.rpe.back());
  }
  std::cout << rowOf(measure, "**mean**", "", meanOf(correlations.ape), meanOf(correlations.rpe))
            << rowOf(measure, "**median**", "", median(correlations.ape), median(correlations.rpe));
}
}  // namespace

void rankProxy(const TuneCommand& command)
{
  const SearchInputs inputs = readInputs(command);
  Evaluator evaluator(command, inputs);
  const std::vector<Trial> sets = knownSets(command, inputs);
  (void)evaluator.run(sets, allRecordings(inputs));
  std::vector<std::vector<RunOutcome>> outcomes(inputs.recordings.size());
  for (std::size_t r = 0; r < outcomes.size(); ++r)
    for (const Trial& trial : sets)
      outcomes[r].push_back(evaluator.outcome(trial, r));
  std::cout << "Rank correlation (Spearman) with the true error over " << sets.size()
            << " parameter sets; runs that were lost are left out\n\n"
               "| measure | recording | runs | APE | RPE |\n|---|---|--:|--:|--:|\n";
  for (const std::string measure : kMeasures)
    printRows(measure, inputs, outcomes);
}
}  // namespace fastlio
