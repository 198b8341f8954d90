// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion_fit.h Velocity and gravity from the poses of several scans and the inertial data
 * between them, by linear least squares. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/math/pose.h>

#include <vector>

namespace fastlio
{
/** The prior of the fit. */
struct MotionFitPrior
{
  Vec3 gyro_bias = Vec3::Zero();   //!< [rad/s]
  Vec3 accel_bias = Vec3::Zero();  //!< [m/s^2]
  Vec3 g = Vec3::Zero();           //!< world frame; its direction need not be right [m/s^2]
  double gravity_std = 0.02;       //!< of its magnitude [m/s^2]
  double position_std = 0.02;      //!< of each pose [m]
};

struct MotionFit
{
  Vec3 velocity = Vec3::Zero();  //!< at the first pose, world frame [m/s]
  Vec3 g = Vec3::Zero();         //!< [m/s^2]
  bool solved = false;           //!< false: fewer than four poses, or numbers that are not finite
};

/** Solves p_k = p + v (t_k - t_1) + g (t_k - t_1)^2 / 2 + S_k for p, v and g, where S_k is the
 * specific force between t_1 and t_k, integrated twice with the attitude of the poses. The map's
 * errors shift all poses but the first together, so that p is free and the first position does not
 * take part.
 * \param poses of the IMU, where the scans put it
 * \param inputs hold from their stamps on, as ImuBuffer::inputsBetween() gives them from the first
 * pose to the last */
[[nodiscard]] MotionFit fitMotion(
    const std::vector<StampedPose>& poses, const std::vector<ImuSample>& inputs,
    const MotionFitPrior& prior);

}  // namespace fastlio
