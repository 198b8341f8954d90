// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h Options of fastlio-calibrate. */
#pragma once

#include "../shared/given_parameters.h"
#include <fastlio/survey/recording_parts.h>

#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
enum class CalibrateStatus
{
  Ok = 0,
  Usage = 1,
  Unusable = 2,  //!< a recording cannot be read, has no usable sensors, or no scan was tracked
  NotWritten = 5,
  NotBetter = 6  //!< written, but on data that it was not fitted to it is not better
};

struct CalibrateArguments
{
  std::vector<std::string> recordings;
  Joining joining = Joining::ByStamps;
  ParameterOptions parameters;
  std::string output = "calibration.yaml";
  bool overwrite = false;  //!< also an output that the program has not written
  std::string json;        //!< empty: none; "-": instead of the table
  int passes = 8;
  bool trial = true;
  bool quiet = false;
};

/** The arguments, or the exit status to end with. */
[[nodiscard]] std::variant<CalibrateArguments, int> parseCommandLine(
    int argc, const char* const* argv);

}  // namespace fastlio
