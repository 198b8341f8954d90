// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file trials.h Parameter sets, their runs, and the order in which they are tried. */
#pragma once

#include "search_inputs.h"
#include <fastlio/tuning/job_store.h>
#include <fastlio/tuning/verdict.h>

namespace fastlio
{
/** A parameter set. */
struct Trial
{
  std::string yaml;  //!< what differs from the defaults
  Candidate values;  //!< of the searched keys
};

/** Trial 0 is the base, trial 1 the base with the defaults of the searched keys. */
struct Trials
{
  std::vector<Trial> sets;
  std::vector<JudgedRuns> runs;  //!< of each set, one per recording; failed where not run
};

/** The base with other values of the searched keys. */
[[nodiscard]] Trial trialOf(const SearchInputs& inputs, const Candidate& values);

/** Runs sets on recordings by way of the store. */
class Evaluator
{
 public:
  Evaluator(const TuneCommand& command, const SearchInputs& inputs);
  /** Adds jobs to the store, and runs none. \param recordings indices */
  void add(const std::vector<Trial>& sets, const std::vector<std::size_t>& recordings);
  /** The base must have been among the sets of this or an earlier call: a run that lasts less than
   * that of the base is truncated.
   * \param recordings indices; the others stay out */
  [[nodiscard]] std::vector<JudgedRuns> run(
      const std::vector<Trial>& sets, const std::vector<std::size_t>& recordings);
  [[nodiscard]] RunOutcome outcome(const Trial& trial, std::size_t recording);

 private:
  [[nodiscard]] Job jobOf(const Trial& trial, std::size_t recording) const;
  [[nodiscard]] Judged judgedOf(const RunOutcome& run, std::size_t recording);
  const TuneCommand& command_;
  const SearchInputs& inputs_;
  Trial base_;
  JobStore store_;
};

/** The base, the defaults of the searched keys, and what the method tries without knowing results
 * (all but cmaes). */
[[nodiscard]] std::vector<Trial> knownSets(const TuneCommand& command, const SearchInputs& inputs);

/** Tries sets on some of the recordings. */
[[nodiscard]] Trials search(
    const TuneCommand& command, const SearchInputs& inputs, Evaluator& evaluator,
    const std::vector<std::size_t>& recordings);

/** Their indices. */
[[nodiscard]] std::vector<std::size_t> allRecordings(const SearchInputs& inputs);
}  // namespace fastlio
