// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file short_simulation.h Settings of small simulations for tests. */
#pragma once

#include <fastlio/simulation/simulation.h>

namespace fastlio::testing
{
/** A scenario of the given length [s] with few points per sweep. */
inline SimulationSettings shortSettings(std::string_view scenario, double duration, int stride = 40)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.duration = duration;
  settings.lidar.stride = stride;
  return settings;
}

/** Takes every error off the sensors. */
inline SimulationSettings withoutErrors(SimulationSettings settings)
{
  settings.lidar.range_noise = 0.0;
  settings.lidar.dropout = 0.0;
  settings.imu.noise = {0.0, 0.0, 0.0, 0.0};
  settings.imu.gyro_bias_std = 0.0;
  settings.imu.accel_bias_std = 0.0;
  settings.imu.vibration_gyro = 0.0;
  settings.imu.vibration_accel = 0.0;
  return settings;
}

}  // namespace fastlio::testing
