// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h Options of fastlio-import. */
#pragma once

#include "rawlog_parts.h"
#include <fastlio/lidar/point_time.h>

#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
enum class ImportStatus
{
  Ok = 0,
  Usage = 1,
  Unusable = 2,    //!< nothing could be read
  Incomplete = 3,  //!< written, but some of the recording could not be read
  Interrupted = 130
};

struct ImportArguments
{
  std::vector<std::string> input_files;
  RawlogParts::Options output;
  bool overwrite = false, list = false, quiet = false;
  bool merge = false;                  //!< the inputs were recorded at the same time
  std::string run, trajectory;         //!< folder or file to be written with it, MCAP only
  std::string lidar_topic, imu_topic;  //!< regular expressions; empty: all
  PointTimeReading point_times{PointTimeUnit::Auto, PointTimeReference::Auto};
};

/** The arguments, or the exit status when the program ends here. */
[[nodiscard]] std::variant<ImportArguments, int> parseCommandLine(
    int argc, const char* const* argv);

}  // namespace fastlio
