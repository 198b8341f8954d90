// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
ParameterRows mapStartRows()
{
  return {
      {"initialization.pose_position_std", "m",
       RealValue{[](auto& p) { return &p.initialization.pose_position_std; }, 0.0, 100.0},
       "a start in a given map (--map-in): uncertainty of the position that is given; the first "
       "scan is searched that far around it"},
      {"initialization.pose_yaw_std", "deg",
       RealValue{[](auto& p) { return &p.initialization.pose_yaw_std; }, 0.0, 180.0, kRadPerDeg},
       "the same of the heading; searched to twice as much"},
      {"initialization.pose_tilt_std", "deg",
       RealValue{[](auto& p) { return &p.initialization.pose_tilt_std; }, 0.0, 45.0, kRadPerDeg},
       "the same of the vertical: how far gravity of this run and of the map's may differ"},
      {"initialization.map_share", "",
       RealValue{[](auto& p) { return &p.initialization.map_share; }, 0.0, 1.0},
       "share of a scan's points that must match a given map before the pose counts as found"},
  };
}

}  // namespace fastlio
