// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file session_input.h The runs of a command line as sessions. */
#pragma once

#include "command_line.h"
#include <fastlio/mapping/session.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The recordings of one run, and the parameters that it was made with. */
struct RunInput
{
  std::string name;  //!< different for each run, fit for a file name
  std::vector<std::string> files;
  std::optional<Config> parameters;  //!< of a run's folder: all, as they were used
  std::string note = {};             //!< on files that were joined; empty: nothing
};

/** The inputs that the arguments name, folders of runs taken apart.
 * \exception std::runtime_error a folder is none of a run, or its recording is gone
 * \exception std::invalid_argument a recording is named twice */
[[nodiscard]] std::vector<RunInput> runInputs(const MapArguments& arguments);

/** Opens the recordings. \exception std::exception as Session::Session() and readConfigFile() */
[[nodiscard]] std::vector<Session> openSessions(
    const MapArguments& arguments, const std::vector<RunInput>& inputs);

}  // namespace fastlio
