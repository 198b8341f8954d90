// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file static_initializer.h Gravity, biases and their covariances from a resting start. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/filter/state.h>
#include <fastlio/interface/odometry_options.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** How well initialization.gravity is known: on the surface of the earth |g| varies by 0.05 m/s^2
 * [m/s^2]. */
inline constexpr double kGravityStd = 0.02;

/** What is slower than noise and engines in the samples at rest, as of somebody who stands. It may
 * happen along any axis: a slow turn about one of them does not show in a short time. */
struct Sway
{
  double rate = 0.0, force = 0.0;  //!< standard deviations along the worst axes [rad/s], [m/s^2]
  double velocity = 0.0;           //!< that the force may make [m/s]
};

/** Mean and scatter of the samples at rest; evidence of the initialisation. */
struct RestStatistics
{
  std::size_t samples = 0;
  Vec3 gyro_mean = Vec3::Zero(), gyro_std = Vec3::Zero();    //!< [rad/s]
  Vec3 accel_mean = Vec3::Zero(), accel_std = Vec3::Zero();  //!< [m/s^2]
  double seconds = 0.0;                                      //!< from the first sample to the last
  Sway sway;
};

[[nodiscard]] RestStatistics restStatistics(const std::vector<ImuSample>& samples);

/** How many of the leading samples rest like the window's first half; all of them when the platform
 * does not move off. Blocks of a twentieth of the window are compared by their means: those of the
 * first half show the size of vibration and noise, and a later one that departs from them ends the
 * rest. Without this, a platform that creeps off just before the first scan starts with a velocity
 * of zero that it no longer has, and with a gravity that leans into its acceleration. */
[[nodiscard]] std::size_t restingSamples(const std::vector<ImuSample>& samples);

/** Why the statistics are not those of a platform at rest, in a sentence that names the numbers and
 * what to do; nothing when they are. */
[[nodiscard]] std::optional<std::string> whyNotAtRest(
    const RestStatistics& rest, const InitializationOptions& parameters);

/** The state at rest: velocity zero, gyro bias = mean rate, gravity opposite to the mean specific
 * force with the configured length, accelerometer bias and gravity jointly from one Kalman update
 * with the mean specific force (which makes their errors correlated, as they are: at rest only
 * their difference is observed). Position and attitude define the world frame: their variance is
 * zero. Where the platform sways, velocity, biases and gravity are as uncertain as that makes them.
 */
[[nodiscard]] FilterState initialState(
    const RestStatistics& rest, const InitializationOptions& parameters);

}  // namespace fastlio
