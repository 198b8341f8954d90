// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h The arguments of fastlio-replay. */
#pragma once

#include "../shared/given_parameters.h"
#include <fastlio/survey/recording_parts.h>

#include <mrpt/system/COutputLogger.h>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** The command line as given. */
struct ReplayArguments
{
  ParameterOptions parameters;
  std::vector<std::string> input_files;           //!< recordings, in order
  Joining joining = Joining::ByStamps;            //!< which of them are parts of one
  bool batch = false;                             //!< they are recordings of their own, or parts
  bool in_order = false;                          //!< the parts are known to follow each other
  std::string output_directory;                   //!< empty: none
  std::string output_tum_path;                    //!< empty: none
  bool overwrite = false;                         //!< also files that no run has written
  std::optional<std::string> lidar_sensor_label;  //!< overrides input.lidar_sensor_label
  std::optional<std::string> imu_sensor_label;    //!< overrides input.imu_sensor_label
  std::size_t skip_first_n = 0;                   //!< scans that are left out at the start
  std::size_t only_first_n = 0;                   //!< scans that are used after those; 0: all
  std::vector<std::string> exporters;             //!< overrides output.exporters
  bool imu_rate = false;                          //!< sets the parameter output.imu_rate
  std::string map_in;                             //!< a saved map to start in; empty: none
  std::vector<double> initial_pose;               //!< x y z yaw pitch roll [m, deg]; empty: origin
  std::string reference;                          //!< to compare with in the report; empty: none
  bool calibrate = false;                         //!< the rig, with the recording, before the run
  bool no_map_update = false;                     //!< sets the parameter map.update to false
  std::string dump_config;                        //!< "all" or "main": print and run nothing
  std::string frame = "vehicle";                  //!< or "imu"
  std::optional<int> threads;                     //!< overrides the parameter `threads`
  mrpt::system::VerbosityLevel verbosity = mrpt::system::LVL_INFO;
  bool quiet = false;  //!< nothing but errors
};

/** The arguments, or the exit status when there is nothing (more) to do: help and version have been
 * printed then, or what is wrong with the command line. */
[[nodiscard]] std::variant<ReplayArguments, int> parseCommandLine(
    int argc, const char* const* argv);

}  // namespace fastlio
