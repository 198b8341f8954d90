// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_run.h"

#include "needed_changes.h"
#include "tuning_report.h"
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/own_file.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>

#include <algorithm>
#include <iostream>
#include <map>

namespace fastlio
{
namespace
{
/** Of each recording, what the others choose and how that does on it. Sets that no result has
 * influenced are the same for every recording left out; a search that follows results runs anew
 * without it. */
void leaveEachOut(
    const TuneCommand& command, const SearchInputs& inputs, Evaluator& evaluator,
    TuningResult& result)
{
  for (std::size_t r = 0; r < inputs.recordings.size(); ++r)
  {
    auto others = allRecordings(inputs);
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
    Trial chosen;
    if (command.search.method == "cmaes")
    {
      const Trials trials = search(command, inputs, evaluator, others);
      chosen = trials.sets[bestTrial(trials.runs, others)];
    }
    else
      chosen = result.trials.sets[bestTrial(result.trials.runs, others)];
    result.chosen.push_back(chosen.values);
    result.left_out.push_back(evaluator.run({chosen}, {r}).front()[r]);
  }
}

/** Each reason once, with the number of runs that ended so. */
std::vector<std::string> failuresOf(
    const SearchInputs& inputs, Evaluator& evaluator, const Trials& trials)
{
  std::map<std::string, std::size_t> reasons;
  for (const Trial& trial : trials.sets)
    for (std::size_t r = 0; r < inputs.recordings.size(); ++r)
      if (const RunOutcome outcome = evaluator.outcome(trial, r); outcome.state == RunState::Failed)
        ++reasons[outcome.message];
  std::vector<std::string> texts;
  texts.reserve(reasons.size());
  for (const auto& [reason, count] : reasons)
    texts.push_back(countedText(count, "run") + ": " + reason);
  return texts;
}

void sayPlan(const TuneCommand& command, const SearchInputs& inputs)
{
  if (command.quiet) return;
  const std::size_t n = inputs.recordings.size();
  std::cerr << "fastlio-tune: measure " << nameWithUnit(inputs.measure);
  if (inputs.measure == "proxy") std::cerr << ", as no recording has ground truth";
  std::cerr << "; store " << command.runner.store << '\n';
  if (command.search.method == "cmaes" && n > 1)
    std::cerr << "fastlio-tune: one search on all " << n
              << " recordings, and one without each: up to " << command.search.budget * n * n
              << " runs\n";
}
}  // namespace

Conclusion tune(const TuneCommand& command)
{
  const SearchInputs inputs = readInputs(command);
  if (!command.overwrite)
  {
    requireOwnFile(command.files.output, {"fastlio-tune", kParameterMark});
    requireOwnFile(command.files.report, {"fastlio-tune", pageBeginning(kPageTitle)});
  }
  sayPlan(command, inputs);
  Evaluator evaluator(command, inputs);
  const auto all = allRecordings(inputs);
  TuningResult result;
  result.trials = search(command, inputs, evaluator, all);
  result.best = bestTrial(result.trials.runs, all);
  if (all.size() > 1) leaveEachOut(command, inputs, evaluator, result);
  result.failures = failuresOf(inputs, evaluator, result.trials);
  result.effects = effectsOf(command, inputs, result.trials);
  result.conclusion =
      concludeFrom(result.trials.runs[0], result.trials.runs[result.best], result.left_out);
  // Workers elsewhere may have ended, as the sets of the search are finished.
  TuneCommand here = command;
  here.runner.jobs = std::max(1, command.runner.jobs);
  here.retry_failed = false;
  Evaluator checks(here, inputs);
  keepNeededChanges(inputs, checks, result);
  if (result.conclusion == Conclusion::Better)
    writeFileAtomically(command.files.output, toParameterFile(command, inputs, result));
  if (!command.files.json.empty())
    writeFileAtomically(command.files.json, toJson(command, inputs, result));
  writeFileAtomically(command.files.report, toPage(command, inputs, result));
  std::cout << toTable(command, inputs, result);
  if (!command.quiet) std::cout << "Page: " << command.files.report << '\n';
  return result.conclusion;
}
}  // namespace fastlio
