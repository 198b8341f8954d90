// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/scenarios/settings_table.h>

#include <algorithm>
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

namespace
{
/** Of all sensors, since 1970 [s]. */
double earliestStamp(const SimulationSettings& settings)
{
  const LidarSettings& lidar = settings.lidar;
  const ImuSettings& imu = settings.imu;
  const double jitter = imu.stamp_jitter > 0.0 ? 1.0 / imu.rate : 0.0;
  return toSeconds(settings.start_ns) +
         std::min(-jitter, lidar.time_offset + lidar.hidden.clock_error);
}
}  // namespace

void requireValid(const SimulationSettings& settings)
{
  std::string problems;
  for (const auto& problem : problemsOf(settingsTable(), settings))
    problems += "\n  " + problem + ".";
  if (settings.lidar.min_range >= settings.lidar.max_range)
    problems += "\n  lidar.min_range: must be below lidar.max_range.";
  if (earliestStamp(settings) < 0.0)
    problems +=
        "\n  start_time: with lidar.time_offset, lidar.clock_error and imu.stamp_jitter stamps "
        "would be before 1970, which recordings cannot hold; give a later one.";
  if (!problems.empty())
    throw std::invalid_argument("The simulation's settings cannot be used:" + problems);
}

}  // namespace fastlio
