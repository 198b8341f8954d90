// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scenario.h The catalogue of scenarios. */
#pragma once

#include <fastlio/scenarios/settings.h>

#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Name and meaning of a scenario. */
struct ScenarioInfo
{
  std::string_view name;
  std::string_view summary;
};

/** All scenarios in the order in which they are listed. */
[[nodiscard]] std::vector<ScenarioInfo> scenarioCatalog();

/** The settings that a scenario starts from.
 * \exception std::invalid_argument unknown name; the message gives the nearest one */
[[nodiscard]] SimulationSettings defaultSettings(std::string_view scenario);

}  // namespace fastlio
