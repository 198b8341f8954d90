// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_chain.h Where the motions of an odometry lead, and how uncertain that is when they
 * share a drift. */
#pragma once

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/pose.h>
#include <fastlio/run/pose_track.h>

namespace fastlio
{
/** Dead reckoning from a pose on. */
class OdometryChain
{
 public:
  OdometryChain() = default;

  /** \param covariance of the pose: attitude in its frame, position in the world
   * \param drift by which the odometry measures too much [rad/m, m/m], as Drift */
  OdometryChain(
      const Pose& pose, const Matrix6& covariance, const Vector6& drift,
      const Matrix6& drift_covariance)
      : pose_(pose), own_(covariance), drift_(drift), drift_covariance_(drift_covariance)
  {
  }

  /** \param motion as the odometry measured it \param travel its way [m] */
  void advance(const RelativePose& motion, double travel);

  [[nodiscard]] const Pose& pose() const { return pose_; }
  /** To first order; that the pose at the beginning and the drift were found together is left out.
   */
  [[nodiscard]] Matrix6 covariance() const;

 private:
  Pose pose_;
  Matrix6 own_ = Matrix6::Zero();       // without that of the drift
  Matrix6 by_drift_ = Matrix6::Zero();  // derivative of the pose
  Vector6 drift_ = Vector6::Zero();
  Matrix6 drift_covariance_ = Matrix6::Zero();
};

}  // namespace fastlio
