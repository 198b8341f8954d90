// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Least values that the odometry's parameters may have: a noise-free recording is still processed
// with some trust in the model only.
constexpr double kLeastDensity = 1e-6;
constexpr double kLeastRangeNoise = 1e-3;
constexpr double kStaticDuration = 2.0;  // [s]
constexpr double kSettling = 0.2;        // left at rest after it [s]

/** Density of white noise with the power of a sinusoid on top of the sensor's own. */
double withVibration(double density, double amplitude, double rate)
{
  return std::max(kLeastDensity, std::sqrt(density * density + 0.5 * amplitude * amplitude / rate));
}

ImuNoise matchingNoise(const ImuSettings& imu)
{
  return {
      withVibration(imu.noise.gyro_noise_density, imu.vibration_gyro, imu.rate),
      withVibration(imu.noise.accel_noise_density, imu.vibration_accel, imu.rate),
      imu.noise.gyro_bias_walk, imu.noise.accel_bias_walk};
}
}  // namespace

Config matchingConfig(const SimulationSettings& settings)
{
  Config config;
  config.sensors.imu_sensor_label = kImuLabel;
  config.sensors.lidar_sensor_label = kLidarLabel;
  config.sensors.T_vehicle_imu = Pose{};
  config.sensors.T_vehicle_lidar = settings.lidar.T_imu_lidar;
  OdometryOptions& p = config.odometry;
  p.initialization.duration = std::clamp(settings.rest - kSettling, 0.5, kStaticDuration);
  p.initialization.gravity = settings.gravity;
  p.initialization.accel_bias_std =
      std::hypot(settings.imu.accel_bias_std, settings.imu.accel_bias.cwiseAbs().maxCoeff());
  p.initialization.motion_gyro_bias_std =
      std::hypot(settings.imu.gyro_bias_std, settings.imu.gyro_bias.cwiseAbs().maxCoeff());
  p.imu.noise = matchingNoise(settings.imu);
  p.lidar.min_range = settings.lidar.min_range;
  p.lidar.max_range = settings.lidar.max_range;
  p.lidar.time_offset = -settings.lidar.time_offset;
  p.measurement.range_noise = std::max(kLeastRangeNoise, settings.lidar.range_noise);
  return config;
}

OdometryOptions matchingParameters(const SimulationSettings& settings)
{
  return matchingConfig(settings).odometry;
}

}  // namespace fastlio
