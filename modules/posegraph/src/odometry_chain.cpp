// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/posegraph/odometry_chain.h>

#include <utility>

namespace fastlio
{
OdometryChain::OdometryChain(
    const Pose& pose, const Matrix6& covariance, Eigen::VectorXd errors,
    Eigen::MatrixXd error_covariance)
    : pose_(pose),
      own_(covariance),
      errors_(std::move(errors)),
      error_covariance_(std::move(error_covariance)),
      by_errors_(Eigen::MatrixXd::Zero(6, errors_.size()))
{
}

void OdometryChain::advance(const RelativePose& motion, const Eigen::MatrixXd& by_sensor)
{
  const Vector6 excess = by_sensor * errors_;
  const Pose T_a_b{motion.T_a_b.R * expSO3(-excess.head<3>()), motion.T_a_b.p - excess.tail<3>()};
  Matrix6 by_former = Matrix6::Zero();
  by_former.topLeftCorner<3, 3>() = T_a_b.R.transpose();
  by_former.bottomLeftCorner<3, 3>() = -pose_.R * skew(T_a_b.p);
  by_former.bottomRightCorner<3, 3>() = Mat3::Identity();
  Matrix6 by_motion = Matrix6::Identity();
  by_motion.bottomRightCorner<3, 3>() = pose_.R;
  own_ = by_former * own_ * by_former.transpose() +
         by_motion * motion.covariance * by_motion.transpose();
  by_errors_ = by_former * by_errors_ - by_motion * by_sensor;
  pose_ = pose_ * T_a_b;
}

Matrix6 OdometryChain::covariance() const
{
  return own_ + by_errors_ * error_covariance_ * by_errors_.transpose();
}

}  // namespace fastlio
