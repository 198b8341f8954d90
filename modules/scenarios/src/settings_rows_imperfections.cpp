// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>

namespace fastlio
{
namespace
{
constexpr double kRadPerMilliradian = 1e-3;

OptionTable<BeamSettings> laserRows()
{
  return {
      {"lidar.laser_range_std", "m", number(&BeamSettings::laser_range_std, 0.0, 1.0),
       "standard deviation of the constant range offset of each laser line"},
      {"lidar.laser_elevation_std", "deg",
       number(&BeamSettings::laser_elevation_std, 0.0, 5.0, kRadPerDeg),
       "standard deviation of the constant elevation offset of each laser line"},
      {"lidar.laser_azimuth_std", "deg",
       number(&BeamSettings::laser_azimuth_std, 0.0, 5.0, kRadPerDeg),
       "standard deviation of the constant azimuth offset of each laser line"},
      {"lidar.incidence_bias", "m", number(&BeamSettings::incidence_bias, -1.0, 1.0),
       "error of a range at 80 deg of incidence; it grows smoothly from 0 at 0 deg"},
      {"lidar.dark_bias", "m", number(&BeamSettings::dark_bias, -1.0, 1.0),
       "error of a range to a surface of reflectivity 0; linear up to lidar.bright_bias"},
      {"lidar.bright_bias", "m", number(&BeamSettings::bright_bias, -1.0, 1.0),
       "error of a range to a surface of reflectivity 1"},
      {"lidar.divergence_horizontal", "mrad",
       number(&BeamSettings::divergence_horizontal, 0.0, 100.0, kRadPerMilliradian),
       "full width of the beam; with it, edges give mixed ranges"},
      {"lidar.divergence_vertical", "mrad",
       number(&BeamSettings::divergence_vertical, 0.0, 100.0, kRadPerMilliradian),
       "full height of the beam"},
  };
}

OptionTable<BeamSettings> returnRows()
{
  return {
      {"lidar.false_returns", "", number(&BeamSettings::false_returns, 0.0, 1.0),
       "fraction of shots that dust or rain sends back from a short range"},
      {"lidar.packet_loss", "", number(&BeamSettings::packet_loss, 0.0, 1.0),
       "fraction of packets that are lost, one by one"},
      {"lidar.outage_interval", "s", number(&BeamSettings::outage_interval, 0.0, 36000.0),
       "packets are lost for a while once per so much time, at a random place; 0: never"},
      {"lidar.outage_length", "s", number(&BeamSettings::outage_length, 0.0, 36000.0),
       "length of such a loss"},
  };
}

OptionTable<HiddenErrors> hiddenRows()
{
  return {
      {"lidar.clock_error", "s", number(&HiddenErrors::clock_error, -10.0, 10.0),
       "as lidar.time_offset, but config.yaml does not contain it"},
      {"lidar.clock_drift", "us/s", number(&HiddenErrors::clock_drift, -1000.0, 1000.0, 1e-6),
       "how fast lidar.clock_error grows from the start on"},
      {"lidar.pose_rotation_std", "deg", number(&HiddenErrors::rotation_std, 0.0, 90.0, kRadPerDeg),
       "standard deviation, per axis, by which the true mounting is turned from lidar.pose"},
      {"lidar.pose_position_std", "m", number(&HiddenErrors::position_std, 0.0, 10.0),
       "standard deviation, per axis, by which the true mounting is away from lidar.pose"},
  };
}

OptionTable<ImuErrorSettings> inertialRows()
{
  return {
      {"imu.gyro_scale_std", "", number(&ImuErrorSettings::gyro_scale_std, 0.0, 0.5),
       "standard deviation of the scale error of each gyro axis"},
      {"imu.accel_scale_std", "", number(&ImuErrorSettings::accel_scale_std, 0.0, 0.5),
       "standard deviation of the scale error of each accelerometer axis"},
      {"imu.gyro_misalignment_std", "deg",
       number(&ImuErrorSettings::gyro_misalignment_std, 0.0, 30.0, kRadPerDeg),
       "standard deviation of the tilt of each gyro axis towards each other axis"},
      {"imu.accel_misalignment_std", "deg",
       number(&ImuErrorSettings::accel_misalignment_std, 0.0, 30.0, kRadPerDeg),
       "standard deviation of the tilt of each accelerometer axis towards each other axis"},
      {"imu.g_sensitivity_std", "deg/s/g",
       number(&ImuErrorSettings::g_sensitivity_std, 0.0, 100.0, kRadPerDeg / kStandardGravity),
       "standard deviation of what each axis of the specific force adds to each gyro axis"},
      {"imu.bits", "", wholeNumber(&ImuErrorSettings::bits, 0, 32),
       "resolution of the readings: full range in so many bits; 0: not rounded"},
  };
}

OptionTable<CarrierSettings> carrierRows()
{
  return {
      {"carrier.vibration_accel", "m/s^2", number(&CarrierSettings::vibration_accel, 0.0, 100.0),
       "vibration of the platform from 20 to 200 Hz: root mean square of each axis; IMU and LiDAR "
       "ride on it"},
      {"carrier.vibration_gyro", "rad/s", number(&CarrierSettings::vibration_gyro, 0.0, 10.0),
       "the same in rotation"},
      {"carrier.body", "", valueAs<BooleanValue>(&CarrierSettings::body),
       "true: a person stands behind the sensors and moves with them"},
      {"carrier.crowd", "", wholeNumber(&CarrierSettings::crowd, 0, 50),
       "people at arm's length who walk along"},
  };
}

OptionTable<SurfaceSettings> surfaceRows()
{
  return {
      {"surface.glass", "", number(&SurfaceSettings::glass, 0.0, 1.0),
       "fraction of flat, upright surfaces that light passes"},
      {"surface.mirrors", "", number(&SurfaceSettings::mirrors, 0.0, 1.0),
       "fraction of flat, upright surfaces that reflect like a mirror"},
  };
}
}  // namespace

OptionTable<SimulationSettings> imperfectionRows()
{
  using S = SimulationSettings;
  const auto lidar = joinedRows<LidarSettings>(
      {rowsOf(laserRows(), &LidarSettings::beam), rowsOf(returnRows(), &LidarSettings::beam),
       rowsOf(hiddenRows(), &LidarSettings::hidden)});
  return joinedRows<S>(
      {rowsOf(lidar, &S::lidar), rowsOf(rowsOf(inertialRows(), &ImuSettings::errors), &S::imu),
       rowsOf(carrierRows(), &S::carrier), rowsOf(surfaceRows(), &S::surface)});
}

}  // namespace fastlio
