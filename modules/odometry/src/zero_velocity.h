// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file zero_velocity.h The measurements of standing still: v = 0 and w_m = b_w. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/filter/update.h>

#include <optional>

namespace fastlio
{
/** Of the pseudo-measurements v = 0 [m/s] and w = gyro bias [rad/s] (0.05 deg/s): a parked vehicle
 * sways by so much. */
inline constexpr double kZeroVelocityStd = 0.01, kZeroRateStd = 0.0008726646259971648;

/** A posterior and the gain of the update that led to it. */
struct ZeroVelocityUpdate
{
  FilterState posterior;
  MotionGain gain = MotionGain::Zero();
};

/** Kalman update with the pseudo-measurements v = 0 and b_w = mean_rate.
 * \param mean_rate mean angular rate at rest, IMU frame [rad/s]
 * \param velocity_std [m/s] \param rate_std of the mean rate [rad/s]
 * \return nothing when the state contradicts them (beyond 99.99 %) or is not finite: not at rest */
[[nodiscard]] std::optional<ZeroVelocityUpdate> zeroVelocityUpdate(
    const FilterState& prior, const Vec3& mean_rate, double velocity_std, double rate_std);

}  // namespace fastlio
