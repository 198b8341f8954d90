// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "angles.h"

#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
SixNumbers numbersFromPose(const Pose& pose)
{
  const Mat3& R = pose.R;
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  const double roll = std::atan2(R(2, 1), R(2, 2));
  return {pose.p.x(),       pose.p.y(),         pose.p.z(),
          yaw / kRadPerDeg, pitch / kRadPerDeg, roll / kRadPerDeg};
}

}  // namespace fastlio
