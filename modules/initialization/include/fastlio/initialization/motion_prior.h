// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion_prior.h The prior of a platform in motion, before its scans are used. */
#pragma once

#include <fastlio/imu/imu_buffer.h>
#include <fastlio/initialization/motion_window.h>
#include <fastlio/interface/odometry_options.h>

#include <vector>

namespace fastlio
{
/** The inertial inputs of a span of time. */
struct Inputs
{
  std::vector<ImuSample> samples;  //!< each holds from its stamp on
  std::int64_t end_ns = 0;

  /** How long input i holds [s]. */
  [[nodiscard]] double duration(std::size_t i) const;
};

[[nodiscard]] Inputs inputsOf(
    const ImuBuffer& imu, std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold);

/** A state in the world of a start: attitude from the direction of gravity, as in the resting
 * start; position zero; gravity with the configured magnitude. \param g_imu gravity, any length
 * \param v_imu velocity; both in the IMU frame */
[[nodiscard]] NavState startState(
    const Vec3& g_imu, const Vec3& v_imu, const Vec3& gyro_bias, const InitializationOptions& p);

/** Magnitude of the mean specific force, turned to the first frame by the gyro [m/s^2]. */
[[nodiscard]] double meanForce(const Inputs& inputs);

/** Before any scan: the mean specific force, turned to the first frame by the gyro, is gravity but
 * for the change of velocity. */
[[nodiscard]] NavState firstGuess(const Inputs& inputs, const InitializationOptions& p);

/** Eq. 4 backwards: the inverse of propagateMean() with the biases of \a x. */
[[nodiscard]] NavState propagatedBack(NavState x, const Inputs& inputs);

/** How much faster the scans turn than the gyro, on average [rad/s].
 * \param inputs from one pose of the scans to the other */
[[nodiscard]] double unexplainedRate(
    const StampedPose& first, const StampedPose& last, const Inputs& inputs, const Vec3& gyro_bias);

/** The uncertainty of the prior. */
struct PriorWidth
{
  double velocity = 0.0;  //!< [m/s]
  double tilt = 0.0;      //!< of gravity's direction [rad]
};

/** The state x0 at the first scan's begin with a covariance that leaves velocity and biases open
 * and fixes the world by the pose at that scan's *end*. \param first_scan from its begin to its end
 */
[[nodiscard]] FilterState startPrior(
    const NavState& x0, const PriorWidth& width, const Inputs& first_scan,
    const InitializationOptions& p);

/** For scans that end by end_ns. */
[[nodiscard]] MotionWindow motionWindowUntil(std::int64_t end_ns, int target_points);

}  // namespace fastlio
