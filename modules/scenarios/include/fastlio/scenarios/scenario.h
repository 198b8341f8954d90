// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scenario.h The scenarios: one row each. */
#pragma once

#include <fastlio/scenarios/scenes.h>

#include <string_view>
#include <vector>

namespace fastlio
{
/** A scenario: the settings' defaults and the scene. */
struct Scenario
{
  std::string_view name, summary;
  Scene (*scene)(const WorldSettings&);
  void (*adapt)(SimulationSettings&);  //!< changes what differs from the general defaults
  double duration = 0.0;  //!< [s]; 0: one loop of the path with rest, start, stop and rest
};

/** All of them in the order in which they are listed. */
[[nodiscard]] const std::vector<Scenario>& scenarioTable();

/** \exception std::invalid_argument unknown name; the message gives the nearest one */
[[nodiscard]] const Scenario& findScenario(std::string_view name);

/** The settings that a scenario starts from.
 * \exception std::invalid_argument as findScenario() */
[[nodiscard]] SimulationSettings defaultSettings(std::string_view scenario);

}  // namespace fastlio
