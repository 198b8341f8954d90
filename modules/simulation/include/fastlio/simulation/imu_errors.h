// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_errors.h Errors of an inertial sensor that stay as they are: scale, misalignment,
 * sensitivity of the gyro to acceleration, resolution. */
#pragma once

#include <fastlio/scenarios/settings.h>

namespace fastlio
{
/** The measurements of one sensor instead of the angular rate w and the specific force f:
 * gyro w + g_sensitivity f and accel f. */
struct ImuErrors
{
  Mat3 gyro = Mat3::Identity();   //!< 1 + scale error on the diagonal, misalignment [rad] off it
  Mat3 accel = Mat3::Identity();  //!< likewise
  Mat3 g_sensitivity = Mat3::Zero();  //!< [rad/s per m/s^2]
};

/** The errors of the sensor with this seed. */
[[nodiscard]] ImuErrors drawImuErrors(const SimulationSettings& settings);

/** The nearest value of a converter with so many bits over -limit..limit. \param bits 0: v itself
 */
[[nodiscard]] Vec3 quantized(const Vec3& v, double limit, int bits);

}  // namespace fastlio
