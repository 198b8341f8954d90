// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file common_options.h Options that several programs have. */
#pragma once

#include "given_parameters.h"
#include <fastlio/survey/recording_parts.h>

#include <CLI/CLI.hpp>

#include <string>

namespace fastlio
{
/** -c and --set. \param file_text what the file holds */
inline void addParameterOptions(
    CLI::App& app, ParameterOptions& options, const std::string& file_text)
{
  app.add_option("-c,--config", options.config_file, file_text)->type_name("FILE.yaml");
  app.add_option("--set", options.settings, "Set a parameter over the file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);  // what follows is a recording
}

/** --join and --no-join. */
inline void addJoinOptions(CLI::App& app, Joining& joining)
{
  auto* join = app.add_flag_callback(
      "--join", [&joining] { joining = Joining::Always; },
      "The recordings are parts of one, in this order");
  app.add_flag_callback(
         "--no-join", [&joining] { joining = Joining::Never; },
         "Each recording stands alone, also one that continues another")
      ->excludes(join);
}

}  // namespace fastlio
