// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file job_runner.h Workers that take jobs of a store until there are none. */
#pragma once

#include <fastlio/tuning/job_store.h>

#include <string>
#include <vector>

namespace fastlio
{
struct RunnerOptions
{
  std::string store;
  int jobs = 1;             //!< at the same time; 0: others run them
  double timeout = 3600.0;  //!< a longer run counts as failed [s]
  bool progress = false;    //!< says now and then on standard error how many are left
  double wait = 0.0;        //!< a worker without a job waits this long for one to be added [s]
};

/** Ctrl-C or SIGTERM: finished runs are stored, the others given back. */
struct Interrupted
{
};

/** Runs jobs until those of the search are finished, also by other processes that share the store.
 * \exception Interrupted */
void runSearch(const RunnerOptions& options, const std::string& search);

/** Runs jobs of any search of this version until all are finished and none is added any more.
 * \exception Interrupted */
void runAny(const RunnerOptions& options);

/** The version of the program, which names the jobs that it may run. */
[[nodiscard]] std::string programVersion();
}  // namespace fastlio
