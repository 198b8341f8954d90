// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fault_run.h fastlio-replay on a damaged recording, and what has become of it. */
#pragma once

#include "fault_recording.h"

#include <cstddef>
#include <string>

namespace fastlio::testing
{
/** The outcome of a replay. */
struct FaultOutcome
{
  bool ended = false;  //!< by itself, with one of the documented exit statuses
  int exit_status = -1;
  bool outputs_complete = false;  //!< summary, trajectory and the other files are there
  bool finite = false;            //!< every number of trajectory and states is finite
  std::size_t poses = 0;
  double worst_position = 0.0;  //!< largest position error after alignment [m]
  bool named = false;           //!< what the program prints names the fault
  std::string log;
};

/** Writes the bytes as a rawlog, replays it with the recording's parameters and judges the outputs.
 * \param folder for the files
 * \param judge_position worst_position is wanted; needs poses in motion
 * \param words a regular expression that names the fault; empty: none */
[[nodiscard]] FaultOutcome replayBytes(
    const std::string& bytes, const FaultRecording& recording, const std::string& folder,
    bool judge_position, const std::string& words);

}  // namespace fastlio::testing
