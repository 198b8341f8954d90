// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
ParameterRows initializationRows()
{
  return {
      {"initialization.mode", "",
       enumeration([](auto& p) { return &p.initialization.mode; }, {"rest", "motion", "auto"}),
       "rest: the platform has to rest once at the start; motion: velocity, gravity and gyro bias "
       "come from the first scans; auto: at rest where inertial data and scans say so, else in "
       "motion"},
      {"initialization.duration", "s",
       RealValue{[](auto& p) { return &p.initialization.duration; }, 0.1, 60.0},
       "time at rest that is averaged at the start; longer: better gravity direction and gyro "
       "bias"},
      {"initialization.max_gyro_std", "deg/s",
       RealValue{[](auto& p) { return &p.initialization.max_gyro_std; }, 0.001, 500.0, kRadPerDeg},
       "the platform does not rest when the angular rate scatters more than this"},
      {"initialization.max_accel_std", "m/s^2",
       RealValue{[](auto& p) { return &p.initialization.max_accel_std; }, 0.001, 100.0},
       "the platform does not rest when the specific force scatters more than this"},
      {"initialization.max_gyro_mean", "deg/s",
       RealValue{[](auto& p) { return &p.initialization.max_gyro_mean; }, 0.001, 500.0, kRadPerDeg},
       "the platform does not rest when the mean angular rate is above this; must exceed the gyro "
       "bias"},
      {"initialization.gravity", "m/s^2",
       RealValue{[](auto& p) { return &p.initialization.gravity; }, 1.0, 30.0},
       "magnitude of gravity at the start"},
      {"initialization.gravity_std", "m/s^2",
       RealValue{[](auto& p) { return &p.initialization.gravity_std; }, 0.0, 1.0},
       "how well the magnitude of gravity is known"},
      {"initialization.max_gravity_error", "m/s^2",
       RealValue{[](auto& p) { return &p.initialization.max_gravity_error; }, 0.01, 20.0},
       "the platform does not rest when the magnitude of the mean specific force differs more than "
       "this from gravity"},
      {"initialization.gyro_bias_std", "rad/s",
       RealValue{[](auto& p) { return &p.initialization.gyro_bias_std; }, 0.0, 1.0},
       "added to the uncertainty of the averaged gyro bias"},
      {"initialization.accel_bias_std", "m/s^2",
       RealValue{[](auto& p) { return &p.initialization.accel_bias_std; }, 0.0, 10.0},
       "uncertainty of the accelerometer bias at the start, around zero"},
      {"initialization.velocity_std", "m/s",
       RealValue{[](auto& p) { return &p.initialization.velocity_std; }, 0.0, 10.0},
       "uncertainty of the velocity at the start, around zero"},
      {"initialization.gravity_model", "",
       enumeration([](auto& p) { return &p.initialization.gravity_model; }, {"free", "sphere"}),
       "free: gravity is a vector of the state, as in the paper; sphere: its direction only, the "
       "magnitude stays initialization.gravity"},
      {"initialization.align_with_gravity", "",
       BooleanValue{[](auto& p) { return &p.initialization.align_with_gravity; }},
       "true: the z axis of the world points up; false: the world is the first IMU frame, as in "
       "the paper"},
  };
}

ParameterRows motionStartRows()
{
  return {
      {"initialization.motion_duration", "s",
       RealValue{[](auto& p) { return &p.initialization.motion_duration; }, 0.1, 60.0},
       "start in motion: time of the first scans that are looked at; longer: better gravity "
       "direction, later start"},
      {"initialization.motion_points", "",
       IntegerValue{[](auto& p) { return &p.initialization.motion_points; }, 1, 10000000},
       "start in motion: about so many points of these scans are used, when that is more than "
       "downsampling.target_points; a map of few scans needs many to have planes"},
      {"initialization.motion_velocity_std", "m/s",
       RealValue{[](auto& p) { return &p.initialization.motion_velocity_std; }, 0.01, 1000.0},
       "start in motion: so fast the platform may be"},
      {"initialization.motion_gyro_bias_std", "deg/s",
       RealValue{
           [](auto& p) { return &p.initialization.motion_gyro_bias_std; }, 0.0, 60.0, kRadPerDeg},
       "start in motion: uncertainty of the gyro bias, around zero"},
      {"initialization.motion_max_velocity_std", "m/s",
       RealValue{[](auto& p) { return &p.initialization.motion_max_velocity_std; }, 0.001, 1000.0},
       "start in motion: refused when the scans leave the velocity less certain than this in any "
       "direction"},
  };
}

ParameterRows imuRows()
{
  return {
      {"imu.gyro_noise_density", "rad/s/sqrt(Hz)",
       RealValue{[](auto& p) { return &p.imu.noise.gyro_noise_density; }, 1e-7, 10.0},
       "white noise of the angular rate; above the data sheet when the IMU vibrates"},
      {"imu.accel_noise_density", "m/s^2/sqrt(Hz)",
       RealValue{[](auto& p) { return &p.imu.noise.accel_noise_density; }, 1e-7, 100.0},
       "white noise of the specific force; above the data sheet when the IMU vibrates"},
      {"imu.gyro_bias_walk", "rad/s^2/sqrt(Hz)",
       RealValue{[](auto& p) { return &p.imu.noise.gyro_bias_walk; }, 0.0, 10.0},
       "how fast the gyro bias wanders"},
      {"imu.accel_bias_walk", "m/s^3/sqrt(Hz)",
       RealValue{[](auto& p) { return &p.imu.noise.accel_bias_walk; }, 0.0, 100.0},
       "how fast the accelerometer bias wanders"},
      {"imu.hold", "", enumeration([](auto& p) { return &p.imu.hold; }, {"midpoint", "left"}),
       "input between two samples: midpoint is their interpolation in the middle of the period; "
       "left is the sample at its start, as in the paper"},
      {"imu.max_gap", "s", RealValue{[](auto& p) { return &p.imu.max_gap; }, 0.001, 60.0},
       "a longer gap between inertial samples splits the run: start anew, with the pose carried "
       "over; shorter ones are bridged with more noise"},
  };
}

ParameterRows lidarRows()
{
  return {
      {"lidar.min_range", "m", RealValue{[](auto& p) { return &p.lidar.min_range; }, 0.0, 1000.0},
       "nearer points are dropped: the platform itself, the operator"},
      {"lidar.max_range", "m", RealValue{[](auto& p) { return &p.lidar.max_range; }, 0.1, 10000.0},
       "farther points are dropped"},
      {"lidar.max_waiting", "s", RealValue{[](auto& p) { return &p.lidar.max_waiting; }, 0.1, 1e6},
       "a scan is given up when the inertial data have not reached it although scans of so much "
       "time have arrived after it: bounds the memory when the IMU fails"},
      {"lidar.time_offset", "s",
       RealValue{[](auto& p) { return &p.lidar.time_offset; }, -10.0, 10.0},
       "added to the stamps of the LiDAR to bring them to the clock of the IMU"},
      {"lidar.deskew", "", BooleanValue{[](auto& p) { return &p.lidar.deskew; }},
       "motion compensation of every point with its own time (eq. 9-10); false only for scans "
       "without motion inside"},
  };
}

ParameterRows calibrationRows()
{
  return {
      {"calibration.estimate_extrinsic", "",
       BooleanValue{[](auto& p) { return &p.calibration.estimate_extrinsic; }},
       "true: the pose of the LiDAR in the IMU frame is part of the state; what the motion does "
       "not excite stays as given"},
      {"calibration.extrinsic_rotation_std", "deg",
       RealValue{
           [](auto& p) { return &p.calibration.extrinsic_rotation_std; }, 0.0, 180.0, kRadPerDeg},
       "uncertainty of the given rotation of the LiDAR, per axis"},
      {"calibration.extrinsic_translation_std", "m",
       RealValue{[](auto& p) { return &p.calibration.extrinsic_translation_std; }, 0.0, 10.0},
       "uncertainty of the given position of the LiDAR, per axis"},
      {"calibration.estimate_time_offset", "",
       BooleanValue{[](auto& p) { return &p.calibration.estimate_time_offset; }},
       "true: the time offset between LiDAR and IMU is part of the state, starting at "
       "lidar.time_offset; not in runs that start in motion or with another map.type than planes, "
       "which keep it as given"},
      {"calibration.time_offset_min_share", "",
       RealValue{[](auto& p) { return &p.calibration.time_offset_min_share; }, 0.0, 1.0},
       "the time offset joins the state when this share of a scan's points match: a young map, in "
       "which few do, would take an offset for a turn"},
      {"calibration.time_offset_std", "s",
       RealValue{[](auto& p) { return &p.calibration.time_offset_std; }, 0.0, 1.0},
       "uncertainty of lidar.time_offset"},
  };
}

}  // namespace fastlio
