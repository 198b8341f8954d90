// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"

namespace fastlio
{
namespace
{
using S = SimulationSettings;
}  // namespace

std::vector<SettingRow> cloudRows()
{
  const ChoiceSetting cloud{
      {"native", "xyzirt", "generic", "xyzi"},
      [](const S& s) { return static_cast<std::size_t>(s.lidar.cloud); },
      [](S& s, std::size_t index) { s.lidar.cloud = static_cast<LidarCloud>(index); }};
  const ChoiceSetting unit{
      {"s", "ms", "us", "ns"},
      [](const S& s) { return static_cast<std::size_t>(s.lidar.time_unit); },
      [](S& s, std::size_t index) { s.lidar.time_unit = static_cast<CloudTimeUnit>(index); }};
  const ChoiceSetting reference{
      {"start", "middle", "end", "absolute"},
      [](const S& s) { return static_cast<std::size_t>(s.lidar.time_reference); },
      [](S& s, std::size_t index)
      { s.lidar.time_reference = static_cast<CloudTimeReference>(index); }};
  return {
      {"lidar.cloud", "", cloud,
       "class of the scans; native: raw packets (vlp16), CPointsMapXYZIRT (others); generic: "
       "CGenericPointsMap; xyzi: CPointsMapXYZI, no times"},
      {"lidar.point_time_unit", "", unit, "unit of the times of points in clouds"},
      {"lidar.point_time_reference", "", reference,
       "zero of the times of points and stamp of the scan; absolute: times since 1970, the stamp "
       "is that of the first shot"}};
}

}  // namespace fastlio
