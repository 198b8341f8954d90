// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file batch.h Several recordings, one run each. */
#pragma once

#include "command_line.h"
#include <fastlio/run/run_summary.h>

#include <string>
#include <vector>

namespace fastlio
{
/** A run of a batch and how it ended. */
struct BatchRun
{
  ReplayArguments arguments;
  std::string note = {};  //!< what the user should know before it; empty: nothing
  ExitStatus status = ExitStatus::Ok;
};

/** The runs that a command line asks for: one, or one for each recording. Files that follow each
 * other in time are one recording (Joining::ByStamps), unless the user says otherwise. A run
 * without any output gets a folder of its own.
 * \exception std::invalid_argument a recording is given twice; the message names both */
[[nodiscard]] std::vector<BatchRun> runsOf(const ReplayArguments& arguments);

/** A row per run: recording, how it ended, folder. */
[[nodiscard]] std::string batchTable(const std::vector<BatchRun>& runs);

}  // namespace fastlio
