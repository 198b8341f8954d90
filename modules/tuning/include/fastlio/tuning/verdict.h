// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file verdict.h Which trial is best, and whether it also holds on recordings that did not choose
 * it. */
#pragma once

#include <fastlio/tuning/run_outcome.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace fastlio
{
/** State and error of a run. */
struct Judged
{
  RunState state = RunState::Failed;
  std::optional<double> error;
};

/** One per recording. */
using JudgedRuns = std::vector<Judged>;

/** How good a trial is over recordings. Runs that are not complete rank behind all that are,
 * whatever their error. Lost runs and runs without an error take no part in the mean: the few poses
 * before a loss have small errors. */
struct Score
{
  std::size_t failed = 0, lost = 0, incomplete = 0;  //!< runs that ended so (see RunState)
  /** Geometric mean of error by error of the base; by 1 where the base is lost, which is the same
   * for all trials. */
  double mean_ratio = 1.0;

  [[nodiscard]] bool operator<(const Score& other) const;
};

/** \param recordings indices of those that count */
[[nodiscard]] Score scoreOf(
    const JudgedRuns& base, const JudgedRuns& trial, const std::vector<std::size_t>& recordings);

/** Error by error of the base; nothing where one of them is missing, or of a lost run. */
[[nodiscard]] std::optional<double> ratioOf(const Judged& base, const Judged& trial);

/** Whether a run is worse than that of the base: in its state, or by more than 5 % in its error,
 * also where its state is better. */
[[nodiscard]] bool isWorse(const Judged& base, const Judged& trial);

/** The trial with the best score among those that make none of the recordings worse. Trial 0 is the
 * base, which always is one of them. */
[[nodiscard]] std::size_t bestTrial(
    const std::vector<JudgedRuns>& trials, const std::vector<std::size_t>& recordings);

enum class Conclusion
{
  Better,           //!< also on recordings that did not choose
  NothingBetter,    //!< the base is the best, or gains less than 5 %
  WorseOnLeftOut,   //!< better where chosen, worse on a recording that was left out
  TooFewRecordings  //!< one recording leaves none out
};

/** \param best of all recordings, which is to be recommended
 * \param left_out per recording, the run on it of the trial that was chosen without it */
[[nodiscard]] Conclusion concludeFrom(
    const JudgedRuns& base, const JudgedRuns& best, const JudgedRuns& left_out);

}  // namespace fastlio
