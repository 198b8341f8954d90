// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/verdict.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace fastlio
{
namespace
{
constexpr double kWorse = 1.05;       // a recording got worse
constexpr double kBetter = 0.95;      // the mean over recordings got better
constexpr double kLeastError = 1e-9;  // so that ratios are finite [m]

std::vector<std::size_t> allOf(const JudgedRuns& runs)
{
  std::vector<std::size_t> indices(runs.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

/** Nothing of a run that was lost. */
std::optional<double> comparableError(const Judged& run)
{
  if (!run.error || run.state >= RunState::Lost) return std::nullopt;
  return std::max(*run.error, kLeastError);
}

/** Whether runs are better than those of the base: in their states, or by 5 % in their errors. */
bool isBetter(const JudgedRuns& base, const JudgedRuns& runs)
{
  Score limit = scoreOf(base, base, allOf(base));
  limit.mean_ratio = kBetter;
  return scoreOf(base, runs, allOf(base)) < limit;
}
}  // namespace

bool Score::operator<(const Score& other) const
{
  return std::tie(failed, lost, incomplete, mean_ratio) <
         std::tie(other.failed, other.lost, other.incomplete, other.mean_ratio);
}

std::optional<double> ratioOf(const Judged& base, const Judged& trial)
{
  const auto of_base = comparableError(base);
  const auto of_trial = comparableError(trial);
  if (!of_base || !of_trial) return std::nullopt;
  return *of_trial / *of_base;
}

Score scoreOf(
    const JudgedRuns& base, const JudgedRuns& trial, const std::vector<std::size_t>& recordings)
{
  Score score;
  double sum = 0.0;
  double count = 0.0;
  for (const std::size_t r : recordings)
  {
    const RunState state = trial[r].state;
    if (state == RunState::Failed)
      ++score.failed;
    else if (state == RunState::Lost)
      ++score.lost;
    else if (state != RunState::Complete)
      ++score.incomplete;
    const auto error = comparableError(trial[r]);
    if (!error) continue;
    sum += std::log(*error / comparableError(base[r]).value_or(1.0));
    count += 1.0;
  }
  if (count > 0.0) score.mean_ratio = std::exp(sum / count);
  return score;
}

bool isWorse(const Judged& base, const Judged& trial)
{
  if (trial.state > base.state) return true;
  const auto ratio = ratioOf(base, trial);
  return ratio && *ratio > kWorse;
}

std::size_t bestTrial(
    const std::vector<JudgedRuns>& trials, const std::vector<std::size_t>& recordings)
{
  const JudgedRuns& base = trials.front();
  std::size_t best = 0;
  Score best_score = scoreOf(base, base, recordings);
  for (std::size_t i = 1; i < trials.size(); ++i)
  {
    const bool worse = std::any_of(
        recordings.begin(), recordings.end(),
        [&](std::size_t r) { return isWorse(base[r], trials[i][r]); });
    const Score score = scoreOf(base, trials[i], recordings);
    if (!worse && score < best_score) best = i, best_score = score;
  }
  return best;
}

Conclusion concludeFrom(const JudgedRuns& base, const JudgedRuns& best, const JudgedRuns& left_out)
{
  if (base.size() < 2) return Conclusion::TooFewRecordings;
  if (!isBetter(base, best)) return Conclusion::NothingBetter;
  for (std::size_t r = 0; r < base.size(); ++r)
    if (isWorse(base[r], left_out[r])) return Conclusion::WorseOnLeftOut;
  return isBetter(base, left_out) ? Conclusion::Better : Conclusion::NothingBetter;
}

}  // namespace fastlio
