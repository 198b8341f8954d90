// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file job_run.h A job as a process of fastlio-replay, and what it amounts to. */
#pragma once

#include <fastlio/tuning/job_store.h>

#include <functional>
#include <optional>

namespace fastlio
{
/** \param go_on asked while the run lasts; false ends it
 * \return nothing when \a go_on has ended it */
[[nodiscard]] std::optional<RunOutcome> runJob(
    const Job& job, double timeout, const std::function<bool()>& go_on);

/** Removes what runs of killed processes of this host have left in the folder for temporary files.
 */
void removeLeftFolders();

/** The program that runs: that beside this one. */
[[nodiscard]] std::string replayProgram();
}  // namespace fastlio
