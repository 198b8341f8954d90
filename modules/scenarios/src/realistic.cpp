// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/scenarios/realistic.h>

#include <set>

namespace fastlio
{
namespace
{
void worsenInertial(ImuSettings& imu)
{
  imu.gyro_bias_std = 0.2 * kRadPerDeg;
  imu.accel_bias_std = 0.1;
  imu.stamp_jitter = 2e-4;
  imu.dropout = 1.0 / 500.0;
  imu.gap_interval = 60.0;
  imu.gap_length = 0.02;
  ImuErrorSettings& e = imu.errors;
  e.gyro_scale_std = e.accel_scale_std = 0.005;
  e.gyro_misalignment_std = e.accel_misalignment_std = 0.2 * kRadPerDeg;
  e.g_sensitivity_std = 0.05 * kRadPerDeg / kStandardGravity;
  e.bits = 16;
}

void worsenBeams(BeamSettings& beam)
{
  beam.laser_range_std = 0.01;
  beam.laser_elevation_std = 0.05 * kRadPerDeg;
  beam.incidence_bias = -0.02;
  beam.dark_bias = 0.016;
  beam.bright_bias = -0.008;
  beam.divergence_horizontal = 3e-3;
  beam.divergence_vertical = 1.5e-3;
  beam.false_returns = 0.002;
  beam.packet_loss = 0.001;
  beam.outage_interval = 60.0;
  beam.outage_length = 0.05;
}
}  // namespace

SimulationSettings realistic(SimulationSettings settings)
{
  worsenInertial(settings.imu);
  worsenBeams(settings.lidar.beam);
  settings.lidar.hidden = {0.004, 0.3 * kRadPerDeg, 0.01};
  settings.surface = {0.05, 0.01};
  settings.carrier.vibration_accel = 0.5;
  settings.carrier.vibration_gyro = 0.02;
  // Nobody walks behind a multirotor or a vehicle.
  const std::set<std::string> alone{"uav", "car", "town", "facades"};
  settings.carrier.body = alone.count(settings.scenario) == 0;
  // The carrier is nearer than what most drivers keep, but not than what the sensors measure.
  if (settings.carrier.body) settings.lidar.min_range = 0.3;
  return settings;
}

}  // namespace fastlio
