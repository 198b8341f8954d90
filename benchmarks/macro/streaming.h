// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file streaming.h A recording from its file through the odometry, as a program does it: reading
 * included. */
#pragma once

#include <fastlio/interface/odometry_options.h>

#include <cstddef>
#include <string>

namespace fastlio::benchmarks
{
/** The cost of one pass over a file. */
struct StreamingResult
{
  double recording_seconds = 0.0;  //!< from the first scan's begin to the last one's end
  double wall_seconds = 0.0;
  double memory_over_start_mb = 0.0;  //!< peak of resident memory minus that before the pass
};

/** Reads, decodes ahead and runs the odometry on a rawlog. Peaks count from the program's start:
 * the first pass of a program says most. \exception std::runtime_error unusable file */
[[nodiscard]] StreamingResult stream(const std::string& rawlog, const OdometryOptions& parameters);

}  // namespace fastlio::benchmarks
