// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file progress_meter.h How far a run is: a bar on a terminal, a log line now and then elsewhere.
 */
#pragma once

#include "../shared/terminal_line.h"

#include <mrpt/system/COutputLogger.h>

#include <chrono>
#include <string>

namespace fastlio
{
/** Where a run stands. */
struct Progress
{
  double done = 0;               //!< fraction of the input [0, 1]
  double recording_seconds = 0;  //!< recording time processed so far
};

/** Shows progress, never more often than people can read. */
class ProgressMeter
{
 public:
  /** Draws a bar when standard error is a terminal and \a logger shows INFO. */
  explicit ProgressMeter(mrpt::system::COutputLogger& logger);

  /** Cheap when nothing is due. */
  void update(const Progress& progress);

  /** Removes the bar, so that other text can be printed. */
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  mrpt::system::COutputLogger& logger_;
  TerminalLine bar_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
};

/** "45 % | 123.4 s of the recording | 12.3 x real time | 0:12 left" */
[[nodiscard]] std::string progressText(const Progress& progress, double elapsed_seconds);

}  // namespace fastlio
