// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scenario_table.h One row per scenario. */
#pragma once

#include <fastlio/scenarios/scenario.h>
#include <fastlio/scenarios/scenes.h>

namespace fastlio
{
/** A scenario: the settings' defaults and the scene. */
struct ScenarioRow
{
  ScenarioInfo info;
  Scene (*scene)(const WorldSettings&);
  void (*adapt)(SimulationSettings&);  //!< changes what differs from the general defaults
  double duration = 0.0;  //!< [s]; 0: one loop of the path with rest, start, stop and rest
};

[[nodiscard]] const std::vector<ScenarioRow>& scenarioTable();

/** \exception std::invalid_argument as defaultSettings() */
[[nodiscard]] const ScenarioRow& findScenario(std::string_view name);

}  // namespace fastlio
