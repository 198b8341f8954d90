// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/config.h>
#include <fastlio/exporters/export_option_table.h>
#include <fastlio/interface/odometry_option_table.h>
#include <fastlio/sensors/sensor_option_table.h>

#include <algorithm>
#include <array>

namespace fastlio
{
namespace
{
using Rows = OptionTable<Config>;

/** In the order in which people set up a run. */
constexpr std::array<std::string_view, 15> kGroups = {
    "input",          "imu",         "lidar",        "lidar_2",  "lidar_3",     "lidar_4",
    "initialization", "calibration", "downsampling", "features", "measurement", "map",
    "update",         "rest",        "recovery"};

/** Groups that are not listed come last, in their own order: output, then single keys. */
auto placeOf(std::string_view key)
{
  return std::find(kGroups.begin(), kGroups.end(), groupOf(key)) - kGroups.begin() +
         (groupOf(key).empty() ? 1 : 0);
}

Rows allRows()
{
  Rows all = joinedRows<Config>(
      {rowsOf(sensorOptionTable(), &Config::sensors),
       rowsOf(odometryOptionTable(), &Config::odometry),
       rowsOf(exportOptionTable(), &Config::exporters)});
  std::stable_sort(
      all.begin(), all.end(),
      [](const auto& a, const auto& b) { return placeOf(a.key) < placeOf(b.key); });
  return all;
}
}  // namespace

const OptionTable<Config>& configTable()
{
  static const Rows table = allRows();
  return table;
}

void validate(const Config& config)
{
  auto problems = problemsOf(sensorOptionTable(), config.sensors);
  for (const auto& more :
       {optionProblems(config.odometry), problemsOf(exportOptionTable(), config.exporters)})
    problems.insert(problems.end(), more.begin(), more.end());
  requireNone(problems, "Config");
}

}  // namespace fastlio
