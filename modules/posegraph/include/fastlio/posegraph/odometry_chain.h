// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_chain.h Where the motions of an odometry lead, and how uncertain that is when they
 * share errors of a sensor. */
#pragma once

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/pose.h>
#include <fastlio/run/pose_track.h>

#include <Eigen/Core>

namespace fastlio
{
/** Dead reckoning from a pose on. */
class OdometryChain
{
 public:
  OdometryChain() = default;

  /** \param covariance of the pose: attitude in its frame, position in the world */
  OdometryChain(const Pose& pose, const Matrix6& covariance) : pose_(pose), own_(covariance) {}
  /** \param errors of the sensor, which all motions have in common, as far as they are known
   * \param error_covariance of them */
  OdometryChain(
      const Pose& pose, const Matrix6& covariance, Eigen::VectorXd errors,
      Eigen::MatrixXd error_covariance);

  /** A motion without errors of the sensor. */
  void advance(const RelativePose& motion)
  {
    advance(motion, Eigen::MatrixXd::Zero(6, errors_.size()));
  }
  /** \param motion as the odometry measured it
   * \param by_sensor 6 x n: how much too much it measures for each error of the sensor */
  void advance(const RelativePose& motion, const Eigen::MatrixXd& by_sensor);

  [[nodiscard]] const Pose& pose() const { return pose_; }
  /** To first order; that the pose at the beginning and the errors were found together is left out.
   */
  [[nodiscard]] Matrix6 covariance() const;

 private:
  Pose pose_;
  Matrix6 own_ = Matrix6::Zero();  // without that of the sensor's errors
  Eigen::VectorXd errors_;
  Eigen::MatrixXd error_covariance_;
  Eigen::MatrixXd by_errors_ = Eigen::MatrixXd::Zero(6, 0);  // 6 x n: derivative of the pose
};

}  // namespace fastlio
