// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/scenarios/settings_table.h>

#include <stdexcept>

namespace fastlio
{
SimulationSettings withSetting(
    SimulationSettings settings, std::string_view key, std::string_view text)
{
  const SettingRow* row = findOption(settingsTable(), key);
  if (row == nullptr)
    throw std::invalid_argument(
        "There is no setting '" + std::string(key) + "'. Did you mean '" +
        nearestKey(settingsTable(), key) + "'?");
  const auto problem = assign(row->value(settings), row->unit, text);
  if (!problem) return settings;
  throw std::invalid_argument(
      "Setting '" + std::string(key) + "' cannot be '" + std::string(text) + "': " + *problem +
      ".");
}

void requireValid(const SimulationSettings& settings)
{
  std::string problems;
  for (const auto& problem : problemsOf(settingsTable(), settings))
    problems += "\n  " + problem + ".";
  if (settings.lidar.min_range >= settings.lidar.max_range)
    problems += "\n  lidar.min_range: must be below lidar.max_range.";
  if (!problems.empty())
    throw std::invalid_argument("The simulation's settings cannot be used:" + problems);
}

}  // namespace fastlio
