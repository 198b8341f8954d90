// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
using S = SimulationSettings;

OptionTable<S> generalRows()
{
  return {
      {"duration", "s", number(&S::duration, 0.0, 36000.0),
       "length of the recording; 0: the scenario's own"},
      {"seed", "", valueAs<SeedValue>(&S::seed),
       "of noise, errors and vibration; world and path do not depend on it"},
      {"start_time", "s", valueAs<EpochValue>(&S::start_ns),
       "stamp of the first IMU sample, seconds since 1970"},
      {"gravity", "m/s^2", number(&S::gravity, 1.0, 30.0), "magnitude of gravity"},
      {"rest", "s", number(&S::rest, 0.0, 36000.0), "time at rest before the motion starts"},
      {"speed", "", number(&S::speed, 0.01, 20.0),
       "factor on the speed of the motion, rotation included"},
      {"path_start", "s", number(&S::path_start, 0.0, 36000.0),
       "where on the scenario's path to start: time of its motion"},
  };
}

OptionTable<WorldSettings> worldRows()
{
  return {
      {"session", "", wholeNumber(&WorldSettings::session, 0, 1000000),
       "another day in the same world: parked cars, furniture and clutter stand elsewhere, are "
       "gone or are new; 0: the first day"},
      {"world.changes", "", number(&WorldSettings::changes, 0.0, 1.0),
       "fraction of the things that can be moved that another session changes"},
      {"world.length", "m", number(&WorldSettings::length, 600.0, 1e5),
       "town: length of the ride; the town grows with it"},
  };
}

OptionTable<LidarSettings> lidarRows()
{
  return {
      {"lidar.kind", "", choice(&LidarSettings::kind, {"vlp16", "os64", "livox", "vlp32c"}),
       "which sensor is simulated"},
      {"lidar.rate", "Hz", number(&LidarSettings::rate, 0.5, 200.0), "sweeps per second"},
      {"lidar.lines", "", wholeNumber(&LidarSettings::lines, 1, 256), "os64: laser lines"},
      {"lidar.columns", "", wholeNumber(&LidarSettings::columns, 4, 8192),
       "os64: columns per revolution"},
      {"lidar.vertical_fov", "deg", number(&LidarSettings::vertical_fov, 0.0, 170.0, kRadPerDeg),
       "os64: angle between the outermost lines"},
      {"lidar.elevation", "deg", number(&LidarSettings::elevation, -85.0, 85.0, kRadPerDeg),
       "os64: elevation in the middle between the outermost lines"},
      {"lidar.point_rate", "Hz", number(&LidarSettings::point_rate, 100.0, 1e7),
       "livox: shots per second"},
  };
}

OptionTable<LidarSettings> lidarFaultRows()
{
  return {
      {"lidar.stride", "", wholeNumber(&LidarSettings::stride, 1, 10000),
       "only every so many-th column or firing is fired: fewer points, same timing"},
      {"lidar.min_range", "m", number(&LidarSettings::min_range, 0.0, 1000.0),
       "nearer surfaces give no return"},
      {"lidar.max_range", "m", number(&LidarSettings::max_range, 0.1, 10000.0),
       "farther surfaces give no return"},
      {"lidar.range_noise", "m", number(&LidarSettings::range_noise, 0.0, 10.0),
       "standard deviation of a range"},
      {"lidar.dropout", "", number(&LidarSettings::dropout, 0.0, 1.0),
       "fraction of returns that are lost"},
      {"lidar.time_offset", "s", number(&LidarSettings::time_offset, -10.0, 10.0),
       "clock error of the LiDAR: added to its true stamps"},
      {"lidar.pose", "m, deg", valueAs<PoseValue>(&LidarSettings::T_imu_lidar),
       "pose of the LiDAR in the IMU frame: x,y,z,yaw,pitch,roll"},
  };
}

OptionTable<LidarSettings> cloudRows()
{
  return {
      {"lidar.cloud", "", choice(&LidarSettings::cloud, {"native", "xyzirt", "generic", "xyzi"}),
       "class of the scans; native: raw packets (vlp16), CPointsMapXYZIRT (others); generic: "
       "CGenericPointsMap; xyzi: CPointsMapXYZI, no times"},
      {"lidar.point_time_unit", "", choice(&LidarSettings::time_unit, {"s", "ms", "us", "ns"}),
       "unit of the times of points in clouds"},
      {"lidar.point_time_reference", "",
       choice(&LidarSettings::time_reference, {"start", "middle", "end", "absolute"}),
       "zero of the times of points and stamp of the scan; absolute: times since 1970, the stamp "
       "is that of the first shot"},
  };
}

OptionTable<ImuNoise> noiseRows()
{
  return {
      {"imu.gyro_noise", "rad/s/sqrt(Hz)", number(&ImuNoise::gyro_noise_density, 0.0, 10.0),
       "density of the white noise of the angular rate"},
      {"imu.accel_noise", "m/s^2/sqrt(Hz)", number(&ImuNoise::accel_noise_density, 0.0, 100.0),
       "density of the white noise of the specific force"},
      {"imu.gyro_walk", "rad/s^2/sqrt(Hz)", number(&ImuNoise::gyro_bias_walk, 0.0, 10.0),
       "how fast the gyro bias wanders"},
      {"imu.accel_walk", "m/s^3/sqrt(Hz)", number(&ImuNoise::accel_bias_walk, 0.0, 100.0),
       "how fast the accelerometer bias wanders"},
  };
}

OptionTable<ImuSettings> biasRows()
{
  return {
      {"imu.gyro_bias", "rad/s", valueAs<VectorValue>(&ImuSettings::gyro_bias),
       "initial gyro bias, x,y,z (its mean when imu.gyro_bias_std is not 0)"},
      {"imu.accel_bias", "m/s^2", valueAs<VectorValue>(&ImuSettings::accel_bias),
       "initial accelerometer bias, x,y,z (its mean when imu.accel_bias_std is not 0)"},
      {"imu.gyro_bias_std", "rad/s", number(&ImuSettings::gyro_bias_std, 0.0, 10.0),
       "standard deviation of the initial gyro bias over seeds"},
      {"imu.accel_bias_std", "m/s^2", number(&ImuSettings::accel_bias_std, 0.0, 100.0),
       "standard deviation of the initial accelerometer bias over seeds"},
  };
}

OptionTable<ImuSettings> imuFaultRows()
{
  return {
      {"imu.stamp_jitter", "s", number(&ImuSettings::stamp_jitter, 0.0, 1.0),
       "standard deviation of the stamps' error, limited to 0.45 periods"},
      {"imu.gyro_limit", "rad/s", number(&ImuSettings::gyro_limit, 0.01, 1e6),
       "saturation of the angular rate"},
      {"imu.accel_limit", "m/s^2", number(&ImuSettings::accel_limit, 0.01, 1e6),
       "saturation of the specific force"},
      {"imu.dropout", "", number(&ImuSettings::dropout, 0.0, 0.99),
       "fraction of samples that are lost, one by one"},
      {"imu.gap_interval", "s", number(&ImuSettings::gap_interval, 0.0, 36000.0),
       "a gap without samples every so often after the rest; 0: none"},
      {"imu.gap_length", "s", number(&ImuSettings::gap_length, 0.0, 36000.0), "length of each gap"},
      {"imu.vibration_gyro", "rad/s", number(&ImuSettings::vibration_gyro, 0.0, 100.0),
       "amplitude of the vibration in the angular rate"},
      {"imu.vibration_accel", "m/s^2", number(&ImuSettings::vibration_accel, 0.0, 1000.0),
       "amplitude of the vibration in the specific force"},
      {"imu.vibration_frequency", "Hz", number(&ImuSettings::vibration_frequency, 0.1, 10000.0),
       "fundamental frequency of the vibration"},
      {"imu.average", "", valueAs<BooleanValue>(&ImuSettings::average),
       "true: samples are means over the period that they end; false: values of the instant"},
  };
}

OptionTable<ImuSettings> imuRows()
{
  return joinedRows<ImuSettings>(
      {{{"imu.rate", "Hz", number(&ImuSettings::rate, 10.0, 10000.0), "samples per second"}},
       rowsOf(noiseRows(), &ImuSettings::noise),
       biasRows(),
       imuFaultRows()});
}

OptionTable<S> allRows()
{
  const auto lidar = joinedRows<LidarSettings>({lidarRows(), lidarFaultRows(), cloudRows()});
  return joinedRows<S>(
      {generalRows(), rowsOf(worldRows(), &S::world), rowsOf(lidar, &S::lidar),
       rowsOf(imuRows(), &S::imu), imperfectionRows(), aidRows()});
}
}  // namespace

const OptionTable<SimulationSettings>& settingsTable()
{
  static const OptionTable<S> table = allRows();
  return table;
}

}  // namespace fastlio
