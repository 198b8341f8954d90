// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h Options of fastlio-info. */
#pragma once

#include "../shared/given_parameters.h"

#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
enum class InfoStatus
{
  Ok = 0,
  Usage = 1,
  Unusable = 2  //!< fastlio-replay could not run on this
};

struct InfoArguments
{
  std::vector<std::string> input_files;
  ParameterOptions parameters;
  std::string json_path;   //!< empty: none; "-": instead of the table
  std::string new_config;  //!< where to write a parameter file; empty: nowhere
  bool check_motion = true;
  bool quiet = false;  //!< no table: only the exit status and the files that are asked for
};

/** The arguments, or the exit status to end with. */
[[nodiscard]] std::variant<InfoArguments, int> parseCommandLine(int argc, const char* const* argv);

}  // namespace fastlio
