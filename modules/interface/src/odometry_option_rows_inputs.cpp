// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_option_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
auto matrix(std::vector<double> ImuOptions::*rows)
{
  return [rows](ImuOptions& o) -> OptionValue
  {
    return NumbersValue{&(o.*rows), 9, 1, 2.0, "nine numbers row by row, near the identity, or []"};
  };
}

OptionTable<InitializationOptions> restingStartRows()
{
  return {
      {"initialization.mode", "", choice(&InitializationOptions::mode, {"rest", "motion", "auto"}),
       "rest: the platform has to rest once at the start; motion: velocity, gravity and gyro bias "
       "come from the first scans; auto: at rest where inertial data and scans say so, else in "
       "motion",
       OptionTier::Main},
      {"initialization.duration", "s", number(&InitializationOptions::duration, 0.1, 60.0),
       "time at rest that is averaged at the start; longer: better gravity direction and gyro bias",
       OptionTier::Main},
      {"initialization.max_gyro_std", "deg/s",
       number(&InitializationOptions::max_gyro_std, 0.001, 500.0, kRadPerDeg),
       "the platform does not rest when the angular rate scatters more than this"},
      {"initialization.max_accel_std", "m/s^2",
       number(&InitializationOptions::max_accel_std, 0.001, 100.0),
       "the platform does not rest when the specific force scatters more than this"},
      {"initialization.max_gyro_mean", "deg/s",
       number(&InitializationOptions::max_gyro_mean, 0.001, 500.0, kRadPerDeg),
       "the platform does not rest when the mean angular rate is above this; must exceed the gyro "
       "bias"},
  };
}

OptionTable<InitializationOptions> startRows()
{
  return {
      {"initialization.gravity", "m/s^2", number(&InitializationOptions::gravity, 1.0, 30.0),
       "magnitude of gravity at the start"},
      {"initialization.max_gravity_error", "m/s^2",
       number(&InitializationOptions::max_gravity_error, 0.01, 20.0),
       "the platform does not rest when the magnitude of the mean specific force differs more than "
       "this from gravity"},
      {"initialization.accel_bias_std", "m/s^2",
       number(&InitializationOptions::accel_bias_std, 0.0, 10.0),
       "uncertainty of the accelerometer bias at the start, around zero"},
      {"initialization.align_with_gravity", "",
       valueAs<BooleanValue>(&InitializationOptions::align_with_gravity),
       "true: the z axis of the world points up; false: the world is the first IMU frame, as in "
       "the paper"},
      {"initialization.motion_duration", "s",
       number(&InitializationOptions::motion_duration, 0.1, 60.0),
       "start in motion: length of the first scans that are used; longer: better gravity "
       "direction, later start"},
      {"initialization.motion_gyro_bias_std", "deg/s",
       number(&InitializationOptions::motion_gyro_bias_std, 0.0, 60.0, kRadPerDeg),
       "start in motion: uncertainty of the gyro bias, around zero"},
      {"initialization.pose_position_std", "m",
       number(&InitializationOptions::pose_position_std, 0.0, 100.0),
       "a start in a given map (--map-in): uncertainty of the position that is given; the first "
       "scan is searched that far around it"},
      {"initialization.pose_yaw_std", "deg",
       number(&InitializationOptions::pose_yaw_std, 0.0, 180.0, kRadPerDeg),
       "the same of the heading; searched to twice as much"},
  };
}

OptionTable<ImuNoise> imuNoiseRows()
{
  return {
      {"imu.gyro_noise_density", "rad/s/sqrt(Hz)",
       number(&ImuNoise::gyro_noise_density, 1e-7, 10.0),
       "white noise of the angular rate; above the data sheet when the IMU vibrates",
       OptionTier::Main},
      {"imu.accel_noise_density", "m/s^2/sqrt(Hz)",
       number(&ImuNoise::accel_noise_density, 1e-7, 100.0),
       "white noise of the specific force; above the data sheet when the IMU vibrates",
       OptionTier::Main},
      {"imu.gyro_bias_walk", "rad/s^2/sqrt(Hz)", number(&ImuNoise::gyro_bias_walk, 0.0, 10.0),
       "random walk of the gyro bias", OptionTier::Main},
      {"imu.accel_bias_walk", "m/s^3/sqrt(Hz)", number(&ImuNoise::accel_bias_walk, 0.0, 100.0),
       "random walk of the accelerometer bias", OptionTier::Main},
  };
}

OptionTable<ImuOptions> imuReadingRows()
{
  return {
      {"imu.hold", "", choice(&ImuOptions::hold, {"midpoint", "left"}),
       "input between two samples: midpoint is their interpolation in the middle of the period; "
       "left is the sample at its start, as in the paper"},
      {"imu.max_gap", "s", number(&ImuOptions::max_gap, 0.001, 60.0),
       "without inertial samples and without a scan that matches for longer, the run is "
       "re-initialised with the pose carried over; shorter gaps are bridged with more noise"},
      {"imu.accel_unit", "", choice(&ImuOptions::accel_unit, {"auto", "m/s^2", "g", "mg"}),
       "unit of the specific force; auto: from the magnitude of the first 0.2 s"},
      {"imu.gyro_unit", "", choice(&ImuOptions::gyro_unit, {"auto", "rad/s", "deg/s"}),
       "unit of the angular rate; auto: rad/s until gravity turns in the sensor's frame as if it "
       "were deg/s, then the run starts anew"},
      {"imu.invert_acceleration", "", valueAs<BooleanValue>(&ImuOptions::invert_acceleration),
       "true: the sensor gives the acceleration of gravity (downwards at rest) instead of the "
       "specific force; a sensor mounted upside down needs nothing"},
      {"imu.gyro_range", "deg/s", number(&ImuOptions::gyro_range, 0.0, 100000.0, kRadPerDeg),
       "full scale of the gyro, where it clips; 0: discovered, as the value that repeats at the "
       "extreme"},
      {"imu.accel_range", "m/s^2", number(&ImuOptions::accel_range, 0.0, 100000.0),
       "full scale of the accelerometer, where it clips; 0: discovered, as the value that repeats "
       "at the extreme"},
      {"imu.gyro_matrix", "", matrix(&ImuOptions::gyro_matrix),
       "scale and axes of the gyro, row by row: reading = matrix * rate + bias; fastlio-calibrate "
       "finds it; empty: the identity"},
      {"imu.accel_matrix", "", matrix(&ImuOptions::accel_matrix), "the same of the accelerometer"},
  };
}

OptionTable<LidarOptions> lidarRows()
{
  return {
      {"lidar.min_range", "m", number(&LidarOptions::min_range, 0.0, 1000.0),
       "nearer points are dropped: the platform itself, the operator", OptionTier::Main},
      {"lidar.max_range", "m", number(&LidarOptions::max_range, 0.1, 10000.0),
       "farther points are dropped", OptionTier::Main},
      {"lidar.time_offset", "s", number(&LidarOptions::time_offset, -10.0, 10.0),
       "added to the stamps of the LiDAR to bring them to the clock of the IMU", OptionTier::Main},
      {"lidar.deskew", "", valueAs<BooleanValue>(&LidarOptions::deskew),
       "motion compensation of every point with its own time (eq. 9-10); false only for scans "
       "without motion inside"},
      {"lidar.beam_offsets", "",
       [](LidarOptions& o) -> OptionValue
       {
         return NumbersValue{
             &o.beam_offsets, 3, 58, 90.0,
             "rows of [elevation in deg, offset of the range in m, of the elevation in deg]"};
       },
       "what the beams of an elevation measure too much, in bins of 2 deg; fastlio-calibrate finds "
       "it"},
  };
}

OptionTable<CalibrationOptions> calibrationRows()
{
  return {
      {"calibration.estimate_extrinsic", "",
       valueAs<BooleanValue>(&CalibrationOptions::estimate_extrinsic),
       "true: the pose of the LiDAR in the IMU frame is corrected where the scans show beyond "
       "doubt that it is wrong; smaller errors only widen the covariance",
       OptionTier::Main},
      {"calibration.estimate_time_offset", "",
       valueAs<BooleanValue>(&CalibrationOptions::estimate_time_offset),
       "true: the time offset between LiDAR and IMU is part of the state, starting at "
       "lidar.time_offset; with another map.type than planes it stays as given",
       OptionTier::Main},
      {"calibration.extrinsic_rotation_std", "deg",
       number(&CalibrationOptions::extrinsic_rotation_std, 0.0, 180.0, kRadPerDeg),
       "uncertainty of the given rotation of the LiDAR, per axis; widens the covariance, and is "
       "the prior of calibration.estimate_extrinsic"},
      {"calibration.extrinsic_translation_std", "m",
       number(&CalibrationOptions::extrinsic_translation_std, 0.0, 10.0),
       "uncertainty of the given position of the LiDAR, per axis; likewise"},
      {"calibration.imu_scale_std", "", number(&CalibrationOptions::imu_scale_std, 0.0, 0.2),
       "uncertainty of the scale of gyro and accelerometer, as a fraction; widens the covariance"},
      {"calibration.imu_misalignment_std", "deg",
       number(&CalibrationOptions::imu_misalignment_std, 0.0, 10.0, kRadPerDeg),
       "uncertainty of the directions of their axes; widens the covariance"},
      {"calibration.estimate_beams", "", valueAs<BooleanValue>(&CalibrationOptions::estimate_beams),
       "true: offsets of the beams, of their ranges, elevations and azimuths, are estimated and "
       "taken off "
       "the scans that follow"},
      {"calibration.time_offset_std", "s", number(&CalibrationOptions::time_offset_std, 0.0, 1.0),
       "uncertainty of lidar.time_offset"},
      {"calibration.time_offset_walk", "s/sqrt(s)",
       number(&CalibrationOptions::time_offset_walk, 0.0, 0.1),
       "how fast the clocks of LiDAR and IMU wander from each other; 0: one clock stamps both"},
  };
}
}  // namespace

OdometryOptionRows inputRows()
{
  using O = OdometryOptions;
  return joinedRows<O>(
      {rowsOf(restingStartRows(), &O::initialization), rowsOf(startRows(), &O::initialization),
       rowsOf(rowsOf(imuNoiseRows(), &ImuOptions::noise), &O::imu),
       rowsOf(imuReadingRows(), &O::imu), rowsOf(lidarRows(), &O::lidar),
       rowsOf(calibrationRows(), &O::calibration)});
}

}  // namespace fastlio
