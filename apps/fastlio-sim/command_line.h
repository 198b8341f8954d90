// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h The options of fastlio-sim. */
#pragma once

#include <fastlio/scenarios/settings.h>

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
/** The arguments of the program. */
struct SimCommand
{
  std::string scenario;
  std::string output_dir;                                      //!< empty: simulated_<scenario>
  std::vector<std::pair<std::string, std::string>> overrides;  //!< key and value, in order
  bool list_scenarios = false;
  bool list_settings = false;
  bool realistic = false;  //!< realistic() before the overrides
  bool quiet = false;
  bool overwrite = false;
};

/** Declares the options on an application, bound to a command that must outlive it. */
void addOptions(CLI::App& app, SimCommand& command);

/** The scenario's defaults, realistic if asked for, with the overrides.
 * \exception std::invalid_argument an unknown name or an unusable value; says what is allowed */
[[nodiscard]] SimulationSettings settingsOf(const SimCommand& command);

/** The lists that --list and --list-settings print; the defaults are those of the given scenario.
 */
[[nodiscard]] std::string scenarioList();
[[nodiscard]] std::string settingsList(const SimulationSettings& defaults);

}  // namespace fastlio
