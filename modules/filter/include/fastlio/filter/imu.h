// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu.h Inertial samples and the noise densities of the sensor. */
#pragma once

#include <fastlio/math/so3.h>

#include <cstdint>

namespace fastlio
{
/** One inertial sample in the IMU frame. */
struct ImuSample
{
  std::int64_t stamp_ns = 0;  //!< time since the UNIX epoch [ns]
  Vec3 gyro = Vec3::Zero();   //!< measured angular rate w_m [rad/s]
  Vec3 accel = Vec3::Zero();  //!< measured specific force a_m [m/s^2], +g upwards at rest
};

/** Continuous-time noise densities of the process model (Q in eq. 8). */
struct ImuNoise
{
  double gyro_noise_density = 5e-4;   //!< n_w [rad/s/sqrt(Hz)]
  double accel_noise_density = 5e-3;  //!< n_a [m/s^2/sqrt(Hz)]
  double gyro_bias_walk = 2e-5;       //!< n_bw [rad/s^2/sqrt(Hz)]
  double accel_bias_walk = 2e-4;      //!< n_ba [m/s^3/sqrt(Hz)]
};

}  // namespace fastlio
