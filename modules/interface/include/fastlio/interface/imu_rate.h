// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_rate.h The state at the rate of the inertial sensor: what is known between two scans.
 */
#pragma once

#include <fastlio/filter/state.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
class ImuBuffer;

/** The state at an inertial sample, propagated (eq. 4-8) from the latest scan before it: causal,
 * nothing measured later takes part. */
struct ImuRateState
{
  std::int64_t stamp_ns = 0;                  //!< of the inertial sample
  NavState x;                                 //!< IMU body in the world
  Vec3 angular_rate = Vec3::Zero();           //!< IMU frame, gyro bias removed [rad/s]
  Matrix6 pose_covariance = Matrix6::Zero();  //!< attitude (IMU frame) [rad], position (world) [m];
                                              //!< with what systematic errors add
};

/** The propagated state at \a stamp_ns as an ImuRateState; nothing when \a imu has no sample with
 * this very stamp. \param systematic what errors of map and calibration add to the covariance */
[[nodiscard]] std::optional<ImuRateState> imuRateState(
    std::int64_t stamp_ns, const FilterState& propagated, const StateMatrix& systematic,
    const ImuBuffer& imu);

}  // namespace fastlio
