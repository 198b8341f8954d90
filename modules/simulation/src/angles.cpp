// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "angles.h"

#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
Pose poseFromNumbers(const SixNumbers& n)
{
  return {
      expSO3({0, 0, n[3] * kRadPerDeg}) * expSO3({0, n[4] * kRadPerDeg, 0}) *
          expSO3({n[5] * kRadPerDeg, 0, 0}),
      {n[0], n[1], n[2]}};
}

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
