// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_run.h"
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

namespace fastlio
{
namespace
{
/** Values of the measures, by name; a set of numbers per recording. */
using Columns = std::map<std::string, std::vector<double>>;

/** Runs that have all the numbers; the others rank last anyhow, by their state. */
Columns columnsOf(Evaluator& evaluator, const std::vector<Trial>& sets, std::size_t recording)
{
  Columns columns;
  for (const Trial& trial : sets)
  {
    const RunOutcome outcome = evaluator.outcome(trial, recording);
    if (outcome.state >= RunState::Lost || !outcome.measure("ape") || !outcome.measure("rpe"))
      continue;
    for (const auto& [name, value] : outcome.measures)
      columns[name].push_back(value);
  }
  return columns;
}
}  // namespace

void rankProxy(const TuneCommand& command)
{
  const SearchInputs inputs = readInputs(command);
  Evaluator evaluator(command, inputs);
  const std::vector<Trial> sets = knownSets(command, inputs);
  (void)evaluator.run(sets, recordingsWithout(inputs, inputs.recordings.size()));
  for (std::size_t r = 0; r < inputs.recordings.size(); ++r)
  {
    const Columns columns = columnsOf(evaluator, sets, r);
    std::cout << printable(inputs.recordings[r].path) << " n " << columns.at("ape").size() << '\n';
    for (const auto& [name, values] : columns)
      if (values.size() == columns.at("ape").size())
        std::cout << "   " << name << " ape "
                  << fixedText(rankCorrelation(values, columns.at("ape")), 2) << " rpe "
                  << fixedText(rankCorrelation(values, columns.at("rpe")), 2) << '\n';
  }
}
}  // namespace fastlio
