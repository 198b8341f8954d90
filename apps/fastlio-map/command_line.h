// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h The arguments of fastlio-map. */
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** The command line as given. */
struct MapArguments
{
  std::vector<std::string> runs;       //!< recordings, or folders of runs
  bool join = false;                   //!< the recordings are parts of one
  bool no_join = false;                //!< none of them is a part of another
  std::string config_file;             //!< empty: defaults
  std::vector<std::string> settings;   //!< KEY=VALUE, over the file
  std::string output_directory;        //!< empty: one named after the first run
  std::vector<std::string> exporters;  //!< names of files; empty: the standard ones
  std::string frame = "vehicle";       //!< or "imu"
  int threads = 0;                     //!< 0: all cores
  bool use_gnss = true;                //!< where a recording has it
  bool use_wheels = true;              //!< likewise
  std::string crs;                     //!< of LAS files; empty: UTM where the place is known
  std::string control_points;          //!< file; empty: none
  bool remove_moving = false;          //!< leave moving objects out of the map
  bool overwrite = false;
  bool quiet = false;
};

/** A file that fastlio-map can write. */
struct MapFileKind
{
  const char* name;     //!< for --export
  const char* file;     //!< NAME stands for the session where there are several
  const char* content;  //!< for people
  bool standard;
};

/** All of them. */
[[nodiscard]] const std::vector<MapFileKind>& mapFileKinds();

/** The arguments, or the exit status to end with. */
[[nodiscard]] std::variant<MapArguments, int> parseCommandLine(int argc, const char* const* argv);

}  // namespace fastlio
