// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pose_parsing.h"

#include <fastlio/options/number_text.h>

#include <Eigen/Geometry>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kQuaternionTolerance = 1e-3;

}  // namespace

Pose parsePoseQuaternion(const std::vector<std::string_view>& seven_columns, const TextPlace& place)
{
  Eigen::Matrix<double, 7, 1> v;
  for (int i = 0; i < 7; ++i)
    v[i] = parseNumber(seven_columns.at(static_cast<std::size_t>(i)), place);
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > kQuaternionTolerance)
    failAt(
        place, "the quaternion's length is " + std::to_string(q.norm()) +
                   ", expected 1 within 0.001; check the columns (x y z qx qy qz qw)");
  return {q.normalized().toRotationMatrix(), v.head<3>()};
}

void appendPose(Trajectory& trajectory, const StampedPose& pose, const TextPlace& place)
{
  if (!trajectory.poses.empty() && pose.stamp_ns <= trajectory.poses.back().stamp_ns)
    failAt(
        place, "time " + secondsText(pose.stamp_ns) + " s is not newer than the one before it, " +
                   secondsText(trajectory.poses.back().stamp_ns) +
                   " s; sort the poses by time and remove repeated ones");
  trajectory.poses.push_back(pose);
}

}  // namespace fastlio
