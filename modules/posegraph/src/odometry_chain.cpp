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

OdometryChain::Step OdometryChain::stepOf(const RelativePose& motion) const
{
  const Pose& T_a_b = motion.T_a_b;
  Step step{Matrix6::Zero(), Matrix6::Identity()};
  step.by_former.topLeftCorner<3, 3>() = T_a_b.R.transpose();
  step.by_former.bottomLeftCorner<3, 3>() = -pose_.R * skew(T_a_b.p);
  step.by_former.bottomRightCorner<3, 3>() = Mat3::Identity();
  step.by_motion.bottomRightCorner<3, 3>() = pose_.R;
  return step;
}

void OdometryChain::advance(const RelativePose& motion)
{
  const Step step = stepOf(motion);
  own_ = step.by_former * own_ * step.by_former.transpose() +
         step.by_motion * motion.covariance * step.by_motion.transpose();
  by_errors_ = step.by_former * by_errors_;
  pose_ = pose_ * motion.T_a_b;
}

void OdometryChain::advance(const RelativePose& motion, const Eigen::MatrixXd& by_sensor)
{
  const Matrix6 by_motion = stepOf(motion).by_motion;
  const Vector6 excess = by_sensor * errors_;
  const Pose& T_a_b = motion.T_a_b;
  advance({{T_a_b.R * expSO3(-excess.head<3>()), T_a_b.p - excess.tail<3>()}, motion.covariance});
  by_errors_ -= by_motion * by_sensor;
}

Matrix6 OdometryChain::covariance() const
{
  return own_ + by_errors_ * error_covariance_ * by_errors_.transpose();
}

}  // namespace fastlio
