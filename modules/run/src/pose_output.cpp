// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/number_text.h>
#include <fastlio/run/pose_output.h>

#include <Eigen/Geometry>

namespace fastlio
{
bool hasPose(ScanStatus status)
{
  return status == ScanStatus::FirstScan || status == ScanStatus::Tracking ||
         status == ScanStatus::PredictionOnly;
}

OutputFrame outputFrameOf(const std::string& name, const Pose& T_vehicle_imu)
{
  return {name, name == "imu" ? Pose{} : T_vehicle_imu.inverse()};
}

PoseEstimate poseEstimateOf(const FilterState& filter, const Pose& T_imu_body)
{
  return poseEstimateOf(filter.x.pose(), filter.P.topLeftCorner<6, 6>(), T_imu_body);
}

PoseEstimate poseEstimateOf(
    const Pose& T_world_imu, const Matrix6& imu_covariance, const Pose& T_imu_body)
{
  Matrix6 J = Matrix6::Identity();
  J.topLeftCorner<3, 3>() = T_imu_body.R.transpose();
  J.bottomLeftCorner<3, 3>() = -T_world_imu.R * skew(T_imu_body.p);
  return {T_world_imu * T_imu_body, J * imu_covariance * J.transpose()};
}

std::string covarianceText(const Matrix6& covariance)
{
  std::string text;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      text += "," + roundTripText(covariance(i, j));
  return text;
}

std::string poseColumns(const Pose& pose, char separator)
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
