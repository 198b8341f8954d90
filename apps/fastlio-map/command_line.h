// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h The arguments of fastlio-map. */
#pragma once

#include "../shared/given_parameters.h"
#include <fastlio/survey/recording_parts.h>

#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** The command line as given. */
struct MapArguments
{
  std::vector<std::string> runs;  //!< recordings, or folders of runs
  Joining joining = Joining::ByStamps;
  ParameterOptions parameters;
  std::string output_directory;        //!< empty: one named after the first run
  std::vector<std::string> exporters;  //!< names of files; empty: the standard ones
  std::string frame = "vehicle";       //!< or "imu"
  int threads = 0;                     //!< 0: all cores
  bool use_gnss = true;                //!< where a recording has it
  bool use_wheels = true;              //!< likewise
  bool same_rig = false;               //!< all recordings are of one rig
  std::string crs;                     //!< of LAS files; empty: UTM where the place is known
  std::string control_points;          //!< file; empty: none
  bool remove_moving = false;          //!< leave moving objects out of the map
  bool overwrite = false;
  bool quiet = false;
};

/** The arguments, or the exit status to end with. */
[[nodiscard]] std::variant<MapArguments, int> parseCommandLine(int argc, const char* const* argv);

}  // namespace fastlio
