// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"

namespace fastlio
{
namespace
{
using S = SimulationSettings;
}  // namespace

OptionTable<SimulationSettings> cloudRows()
{
  return {
      {"lidar.cloud", "",
       [](S& s) -> OptionValue {
         return choice(&s.lidar.cloud, {"native", "xyzirt", "generic", "xyzi"});
       },
       "class of the scans; native: raw packets (vlp16), CPointsMapXYZIRT (others); generic: "
       "CGenericPointsMap; xyzi: CPointsMapXYZI, no times"},
      {"lidar.point_time_unit", "",
       [](S& s) -> OptionValue {
         return choice(&s.lidar.time_unit, {"s", "ms", "us", "ns"});
       },
       "unit of the times of points in clouds"},
      {"lidar.point_time_reference", "",
       [](S& s) -> OptionValue {
         return choice(&s.lidar.time_reference, {"start", "middle", "end", "absolute"});
       },
       "zero of the times of points and stamp of the scan; absolute: times since 1970, the stamp "
       "is that of the first shot"}};
}

}  // namespace fastlio
