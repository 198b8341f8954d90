// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
using S = SimulationSettings;
using Rows = OptionTable<SimulationSettings>;

Rows generalRows()
{
  return {
      {"duration", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.duration, 0.0, 36000.0};
       },
       "length of the recording; 0: the scenario's own"},
      {"seed", "", [](S& s) -> OptionValue { return SeedValue{&s.seed}; },
       "of noise, errors and vibration; world and path do not depend on it"},
      {"start_time", "s", [](S& s) -> OptionValue { return EpochValue{&s.start_ns}; },
       "stamp of the first IMU sample, seconds since 1970"},
      {"gravity", "m/s^2",
       [](S& s) -> OptionValue {
         return RealValue{&s.gravity, 1.0, 30.0};
       },
       "magnitude of gravity"},
      {"rest", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.rest, 0.0, 36000.0};
       },
       "time at rest before the motion starts"},
      {"speed", "",
       [](S& s) -> OptionValue {
         return RealValue{&s.speed, 0.01, 20.0};
       },
       "factor on the speed of the motion, rotation included"},
      {"path_start", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.path_start, 0.0, 36000.0};
       },
       "where on the scenario's path to start: time of its motion"},
  };
}

Rows lidarRows()
{
  return {
      {"lidar.kind", "",
       [](S& s) -> OptionValue {
         return choice(&s.lidar.kind, {"vlp16", "os64", "livox"});
       },
       "which sensor is simulated"},
      {"lidar.rate", "Hz",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.rate, 0.5, 200.0};
       },
       "sweeps per second"},
      {"lidar.lines", "",
       [](S& s) -> OptionValue {
         return IntegerValue{&s.lidar.lines, 1, 256};
       },
       "os64: laser lines"},
      {"lidar.columns", "",
       [](S& s) -> OptionValue {
         return IntegerValue{&s.lidar.columns, 4, 8192};
       },
       "os64: columns per revolution"},
      {"lidar.vertical_fov", "deg",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.vertical_fov, 0.0, 170.0, kRadPerDeg};
       },
       "os64: angle between the outermost lines"},
      {"lidar.elevation", "deg",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.elevation, -85.0, 85.0, kRadPerDeg};
       },
       "os64: elevation in the middle between the outermost lines"},
      {"lidar.point_rate", "Hz",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.point_rate, 100.0, 1e7};
       },
       "livox: shots per second"},
  };
}

Rows lidarFaultRows()
{
  return {
      {"lidar.stride", "",
       [](S& s) -> OptionValue {
         return IntegerValue{&s.lidar.stride, 1, 10000};
       },
       "only every so many-th column or firing is fired: fewer points, same timing"},
      {"lidar.min_range", "m",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.min_range, 0.0, 1000.0};
       },
       "nearer surfaces give no return"},
      {"lidar.max_range", "m",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.max_range, 0.1, 10000.0};
       },
       "farther surfaces give no return"},
      {"lidar.range_noise", "m",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.range_noise, 0.0, 10.0};
       },
       "standard deviation of a range"},
      {"lidar.dropout", "",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.dropout, 0.0, 1.0};
       },
       "fraction of returns that are lost"},
      {"lidar.time_offset", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.lidar.time_offset, -10.0, 10.0};
       },
       "clock error of the LiDAR: added to its true stamps"},
      {"lidar.pose", "m, deg", [](S& s) -> OptionValue { return PoseValue{&s.lidar.T_imu_lidar}; },
       "pose of the LiDAR in the IMU frame: x,y,z,yaw,pitch,roll"},
  };
}

Rows imuNoiseRows()
{
  return {
      {"imu.rate", "Hz",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.rate, 10.0, 10000.0};
       },
       "samples per second"},
      {"imu.gyro_noise", "rad/s/sqrt(Hz)",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.noise.gyro_noise_density, 0.0, 10.0};
       },
       "density of the white noise of the angular rate"},
      {"imu.accel_noise", "m/s^2/sqrt(Hz)",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.noise.accel_noise_density, 0.0, 100.0};
       },
       "density of the white noise of the specific force"},
      {"imu.gyro_walk", "rad/s^2/sqrt(Hz)",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.noise.gyro_bias_walk, 0.0, 10.0};
       },
       "how fast the gyro bias wanders"},
      {"imu.accel_walk", "m/s^3/sqrt(Hz)",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.noise.accel_bias_walk, 0.0, 100.0};
       },
       "how fast the accelerometer bias wanders"},
      {"imu.gyro_bias", "rad/s", [](S& s) -> OptionValue { return VectorValue{&s.imu.gyro_bias}; },
       "initial gyro bias, x,y,z (its mean when imu.gyro_bias_std is not 0)"},
      {"imu.accel_bias", "m/s^2",
       [](S& s) -> OptionValue { return VectorValue{&s.imu.accel_bias}; },
       "initial accelerometer bias, x,y,z (its mean when imu.accel_bias_std is not 0)"},
      {"imu.gyro_bias_std", "rad/s",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.gyro_bias_std, 0.0, 10.0};
       },
       "standard deviation of the initial gyro bias over seeds"},
      {"imu.accel_bias_std", "m/s^2",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.accel_bias_std, 0.0, 100.0};
       },
       "standard deviation of the initial accelerometer bias over seeds"},
  };
}

Rows imuFaultRows()
{
  return {
      {"imu.stamp_jitter", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.stamp_jitter, 0.0, 1.0};
       },
       "standard deviation of the stamps' error, limited to 0.45 periods"},
      {"imu.gyro_limit", "rad/s",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.gyro_limit, 0.01, 1e6};
       },
       "saturation of the angular rate"},
      {"imu.accel_limit", "m/s^2",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.accel_limit, 0.01, 1e6};
       },
       "saturation of the specific force"},
      {"imu.dropout", "",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.dropout, 0.0, 0.99};
       },
       "fraction of samples that are lost, one by one"},
      {"imu.gap_interval", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.gap_interval, 0.0, 36000.0};
       },
       "a gap without samples every so often after the rest; 0: none"},
      {"imu.gap_length", "s",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.gap_length, 0.0, 36000.0};
       },
       "length of each gap"},
      {"imu.vibration_gyro", "rad/s",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.vibration_gyro, 0.0, 100.0};
       },
       "amplitude of the vibration in the angular rate"},
      {"imu.vibration_accel", "m/s^2",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.vibration_accel, 0.0, 1000.0};
       },
       "amplitude of the vibration in the specific force"},
      {"imu.vibration_frequency", "Hz",
       [](S& s) -> OptionValue {
         return RealValue{&s.imu.vibration_frequency, 0.1, 10000.0};
       },
       "fundamental frequency of the vibration"},
      {"imu.average", "", [](S& s) -> OptionValue { return BooleanValue{&s.imu.average}; },
       "true: samples are means over the period that they end; false: values of the instant"},
  };
}

}  // namespace

const OptionTable<SimulationSettings>& settingsTable()
{
  static const Rows table = joinedRows<SimulationSettings>(
      {generalRows(), worldRows(), lidarRows(), lidarFaultRows(), cloudRows(), imuNoiseRows(),
       imuFaultRows(), imperfectionRows(), aidRows()});
  return table;
}

}  // namespace fastlio
