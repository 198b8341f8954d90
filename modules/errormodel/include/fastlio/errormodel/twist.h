// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file twist.h Errors of a pose as rigid motions of the world: in these coordinates an error of the
 * map stays what it is while the sensor moves. */
#pragma once

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/pose.h>

namespace fastlio
{
/** Covariance of a rigid motion (phi, rho) of the map: p -> p + rho + phi x p, world frame. */
using TwistCovariance = Matrix6;

/** L = d(phi, rho) / d(dtheta, dp): phi = R dtheta, rho = dp + [p]x phi; and its inverse. */
[[nodiscard]] Matrix6 twistJacobian(const Pose& T_world_scan);
[[nodiscard]] Matrix6 twistJacobianInverse(const Pose& T_world_scan);

/** The twist covariance that a pose covariance (attitude in the body frame, position in the world
 * frame) means at that pose, and back. */
[[nodiscard]] TwistCovariance twistCovariance(
    const Matrix6& pose_covariance, const Pose& T_world_imu);
[[nodiscard]] Matrix6 poseCovariance(const TwistCovariance& covariance, const Pose& T_world_imu);

}  // namespace fastlio
