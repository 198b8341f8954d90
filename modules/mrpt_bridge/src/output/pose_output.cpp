// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/output/number_text.h>
#include <fastlio/mrpt_bridge/output/pose_output.h>

#include <Eigen/Geometry>

namespace fastlio
{
bool hasPose(ScanStatus status)
{
  return status == ScanStatus::FirstScan || status == ScanStatus::Tracking ||
         status == ScanStatus::PredictionOnly;
}

PoseEstimate poseEstimateOf(const FilterState& filter, const Pose& T_imu_body)
{
  Matrix6 J = Matrix6::Identity();
  J.topLeftCorner<3, 3>() = T_imu_body.R.transpose();
  J.bottomLeftCorner<3, 3>() = -filter.x.R * skew(T_imu_body.p);
  const Matrix6 P_imu = filter.P.topLeftCorner<6, 6>();  // attitude, position
  return {filter.x.pose() * T_imu_body, J * P_imu * J.transpose()};
}

std::string poseText(const Pose& pose, char separator)
{
  Eigen::Quaterniond q(pose.R);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  std::string text;
  for (const double v : {pose.p.x(), pose.p.y(), pose.p.z()})
    text += fixedText(v, 6) + separator;
  for (const double v : {q.x(), q.y(), q.z()})
    text += fixedText(v, 9) + separator;
  return text + fixedText(q.w(), 9);
}

}  // namespace fastlio
