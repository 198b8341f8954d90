// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/twist.h>

namespace fastlio
{
Matrix6 twistJacobian(const Pose& T_world_scan)
{
  Matrix6 L = Matrix6::Identity();
  L.topLeftCorner<3, 3>() = T_world_scan.R;
  L.bottomLeftCorner<3, 3>() = skew(T_world_scan.p) * T_world_scan.R;
  return L;
}

Matrix6 twistJacobianInverse(const Pose& T_world_scan)
{
  Matrix6 L = Matrix6::Identity();
  L.topLeftCorner<3, 3>() = T_world_scan.R.transpose();
  L.bottomLeftCorner<3, 3>() = -skew(T_world_scan.p);
  return L;
}

TwistCovariance twistCovariance(const Matrix6& pose_covariance, const Pose& T_world_imu)
{
  const Eigen::Matrix<double, 6, 6> L = twistJacobian(T_world_imu);
  return L * pose_covariance * L.transpose();
}

Matrix6 poseCovariance(const TwistCovariance& covariance, const Pose& T_world_imu)
{
  const Eigen::Matrix<double, 6, 6> L = twistJacobianInverse(T_world_imu);
  return L * covariance * L.transpose();
}

}  // namespace fastlio
