// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/posegraph/odometry_chain.h>

namespace fastlio
{
void OdometryChain::advance(const RelativePose& motion, double travel)
{
  const Pose& T_a_b = motion.T_a_b;
  Matrix6 by_former = Matrix6::Zero();
  by_former.topLeftCorner<3, 3>() = T_a_b.R.transpose();
  by_former.bottomLeftCorner<3, 3>() = -pose_.R * skew(T_a_b.p);
  by_former.bottomRightCorner<3, 3>() = Mat3::Identity();
  Matrix6 by_motion = Matrix6::Identity();
  by_motion.bottomRightCorner<3, 3>() = pose_.R;
  own_ = by_former * own_ * by_former.transpose() +
         by_motion * motion.covariance * by_motion.transpose();
  by_drift_ = by_former * by_drift_ - travel * by_motion;
  const Vector6 excess = travel * drift_;
  pose_ = pose_ * Pose{T_a_b.R * expSO3(-excess.head<3>()), T_a_b.p - excess.tail<3>()};
}

Matrix6 OdometryChain::covariance() const
{
  return own_ + by_drift_ * drift_covariance_ * by_drift_.transpose();
}

}  // namespace fastlio
