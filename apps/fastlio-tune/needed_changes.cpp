// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "needed_changes.h"

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
/** Whether a set may take the place of the best one. */
bool isAsGood(const TuningResult& result, const JudgedRuns& best, const JudgedRuns& runs)
{
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (isWorse(best[r], runs[r])) return false;
  return concludeFrom(result.trials.runs.front(), runs, result.left_out) == result.conclusion;
}
}  // namespace

void keepNeededChanges(const SearchInputs& inputs, Evaluator& evaluator, TuningResult& result)
{
  if (result.conclusion != Conclusion::Better) return;
  const auto all = allRecordings(inputs);
  const Candidate base = result.trials.sets.front().values;
  const JudgedRuns best = result.trials.runs[result.best];
  Candidate values = result.trials.sets[result.best].values;
  // The smallest effect is the last one.
  for (auto effect = result.effects.rbegin(); effect != result.effects.rend(); ++effect)
  {
    if (effect->certain) continue;
    const auto key = std::find_if(
        inputs.space.begin(), inputs.space.end(),
        [&effect](const SearchKey& one) { return one.key == effect->key; });
    const auto k = static_cast<std::size_t>(std::distance(inputs.space.begin(), key));
    if (k == values.size() || values[k] == base[k]) continue;
    const std::string found = std::exchange(values[k], base[k]);
    const Trial trial = trialOf(inputs, values);
    const JudgedRuns runs = evaluator.run({trial}, all).front();
    if (!isAsGood(result, best, runs))
    {
      values[k] = found;
      continue;
    }
    result.at_base.push_back(effect->key);
    result.trials.sets.push_back(trial);
    result.trials.runs.push_back(runs);
    result.best = result.trials.sets.size() - 1;
  }
}
}  // namespace fastlio
