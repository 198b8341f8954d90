// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "trials.h"

#include <fastlio/tuning/search.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kGridSteps = 3;  // of a range
constexpr std::size_t kEachSteps = 5;
constexpr double kLeastOfBase = 0.9;  // of the duration; a shorter run is truncated

Candidate valuesOf(const SearchInputs& inputs, const Config& config)
{
  Candidate values;
  for (const SearchKey& key : inputs.space)
    values.push_back(valueText(*findOption(configTable(), key.key), config));
  return values;
}

Trial baseSet(const SearchInputs& inputs)
{
  return {baseYaml(inputs), valuesOf(inputs, inputs.base)};
}

/** The base comes first; its values cannot contradict each other, those of the defaults may. */
std::vector<Trial> firstSets(const SearchInputs& inputs)
{
  std::vector<Trial> sets = {baseSet(inputs)};
  const Candidate defaults = valuesOf(inputs, Config{});
  Trial with_defaults = trialOf(inputs, defaults);
  if (with_defaults.yaml != sets[0].yaml) sets.push_back(std::move(with_defaults));
  return sets;
}

std::vector<Trial> eachSets(const SearchInputs& inputs)
{
  const Candidate base = valuesOf(inputs, inputs.base);
  std::vector<Trial> sets;
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
  {
    const SearchKey& key = inputs.space[k];
    const std::size_t steps = key.values.empty() ? kEachSteps : key.values.size();
    for (std::size_t i = 0; i < steps; ++i)
    {
      Candidate values = base;
      values[k] = key.values.empty()
                      ? key.at(static_cast<double>(i) / static_cast<double>(steps - 1))
                      : key.values[i];
      sets.push_back(trialOf(inputs, values));
    }
  }
  return sets;
}

std::vector<std::size_t> gridSteps(const TuneCommand& command, const SearchSpace& space)
{
  std::vector<std::size_t> steps;
  std::size_t points = 1;
  for (const SearchKey& key : space)
  {
    steps.push_back(key.values.empty() ? kGridSteps : key.values.size());
    points *= steps.back();
    if (points > command.search.budget)
      throw std::invalid_argument(
          "the grid has more points than --budget " + std::to_string(command.search.budget) +
          "; raise it, or search fewer keys");
  }
  return steps;
}

std::unique_ptr<Search> searchOf(const TuneCommand& command, const SearchSpace& space)
{
  const SearchOptions& options = command.search;
  if (options.method == "grid") return gridSearch(gridSteps(command, space));
  if (options.method == "random") return randomSearch(space.size(), options.budget, options.seed);
  return cmaesSearch(space.size(), options.budget, options.seed);
}

std::vector<Trial> setsAt(const SearchInputs& inputs, const std::vector<Places>& batch)
{
  std::vector<Trial> sets;
  sets.reserve(batch.size());
  for (const Places& places : batch)
    sets.push_back(trialOf(inputs, candidateAt(inputs.space, places)));
  return sets;
}

/** Places in the order of scores: all that a search needs, and they compare what has no error. */
std::vector<double> orderOf(const std::vector<Score>& scores)
{
  std::vector<double> order;
  order.reserve(scores.size());
  for (const Score& score : scores)
    order.push_back(static_cast<double>(std::count_if(
        scores.begin(), scores.end(), [&](const Score& other) { return other < score; })));
  return order;
}

void append(Trials& trials, const std::vector<Trial>& sets, const std::vector<JudgedRuns>& runs)
{
  trials.sets.insert(trials.sets.end(), sets.begin(), sets.end());
  trials.runs.insert(trials.runs.end(), runs.begin(), runs.end());
}
}  // namespace

Trial trialOf(const SearchInputs& inputs, const Candidate& values)
{
  return {searchedYaml(inputs, configured(inputs.base, inputs.space, values)), values};
}

Evaluator::Evaluator(const TuneCommand& command, const SearchInputs& inputs)
    : command_(command), inputs_(inputs), base_(baseSet(inputs)), store_(command.runner.store)
{
  if (command.retry_failed) store_.retryFailed(inputs.id);
}

Job Evaluator::jobOf(const Trial& trial, std::size_t recording) const
{
  const RecordingInput& input = inputs_.recordings[recording];
  return {inputs_.id, trial.yaml, input.path, input.truth, command_.frame};
}

void Evaluator::add(const std::vector<Trial>& sets, const std::vector<std::size_t>& recordings)
{
  std::vector<Job> jobs;
  for (const Trial& trial : sets)
    for (const std::size_t r : recordings)
      jobs.push_back(jobOf(trial, r));
  store_.add(programVersion(), jobs);
}

std::vector<JudgedRuns> Evaluator::run(
    const std::vector<Trial>& sets, const std::vector<std::size_t>& recordings)
{
  add(sets, recordings);
  runSearch(command_.runner, inputs_.id);
  std::vector<JudgedRuns> judged(sets.size(), JudgedRuns(inputs_.recordings.size()));
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (const std::size_t r : recordings)
      judged[i][r] = judgedOf(outcome(sets[i], r), r);
  return judged;
}

Judged Evaluator::judgedOf(const RunOutcome& run, std::size_t recording)
{
  Judged judged{run.state, run.measure(inputs_.measure)};
  if (judged.state >= RunState::Lost) return judged;
  // Without the number that is asked for there is nothing to compare.
  if (!judged.error) return {RunState::Failed, std::nullopt};
  const auto of_base = outcome(base_, recording).measure("duration");
  if (of_base && run.measure("duration").value_or(0.0) < kLeastOfBase * *of_base)
    judged.state = std::max(judged.state, RunState::Truncated);
  return judged;
}

RunOutcome Evaluator::outcome(const Trial& trial, std::size_t recording)
{
  const auto result = store_.outcome(jobOf(trial, recording));
  if (!result)
    throw std::runtime_error(
        "job store '" + command_.runner.store + "' has lost a finished run; was it replaced?");
  return *result;
}

std::vector<Trial> knownSets(const TuneCommand& command, const SearchInputs& inputs)
{
  std::vector<Trial> sets = firstSets(inputs);
  std::vector<Trial> more;
  if (command.search.method == "each")
    more = eachSets(inputs);
  else if (command.search.method != "cmaes")
    more = setsAt(inputs, searchOf(command, inputs.space)->ask());
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

Trials search(
    const TuneCommand& command, const SearchInputs& inputs, Evaluator& evaluator,
    const std::vector<std::size_t>& recordings)
{
  Trials trials;
  const std::vector<Trial> known = knownSets(command, inputs);
  append(trials, known, evaluator.run(known, recordings));
  if (command.search.method != "cmaes") return trials;
  const auto method = searchOf(command, inputs.space);
  for (auto batch = method->ask(); !batch.empty(); batch = method->ask())
  {
    const std::vector<Trial> sets = setsAt(inputs, batch);
    const auto runs = evaluator.run(sets, recordings);
    append(trials, sets, runs);
    std::vector<Score> scores;
    scores.reserve(runs.size());
    for (const JudgedRuns& one : runs)
      scores.push_back(scoreOf(trials.runs[0], one, recordings));
    method->tell(orderOf(scores));
    if (!command.quiet)
      std::cerr << "fastlio-tune: " << trials.sets.size() - known.size() << " of "
                << command.search.budget << " parameter sets tried\n";
  }
  return trials;
}

std::vector<std::size_t> allRecordings(const SearchInputs& inputs)
{
  std::vector<std::size_t> indices(inputs.recordings.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}
}  // namespace fastlio
