// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file job_runner.h Runs jobs of the store as processes of fastlio-replay. */
#pragma once

#include <fastlio/tuning/job_store.h>

#include <string>
#include <vector>

namespace fastlio
{
struct RunnerOptions
{
  std::string store;
  std::string measure = "ape";  //!< ape or rpe
  int jobs = 1;                 //!< at the same time
  double timeout = 3600.0;      //!< a longer run counts as failed [s]
};

/** Names measure, path and state of a recording, so that a changed file is another job. */
[[nodiscard]] std::string recordingId(const std::string& measure, const std::string& path);

/** The truth beside NAME.rawlog: NAME.gt.tum. */
[[nodiscard]] std::string truthOf(const std::string& recording);

/** Runs jobs until those given have results, also by other processes that share the store. */
void runJobs(const RunnerOptions& options, const std::vector<Job>& wanted);
}  // namespace fastlio
