// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameters.h Every number that a user may change, with its default. Names equal the YAML keys
 * (group.key); unit, range and effect stand in the table of parameter_table.cpp. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/filter/update.h>

#include <array>
#include <string>

namespace fastlio
{
/** Group `initialization`. */
struct InitializationParameters
{
  double duration = 2.0;           //!< resting time that is averaged [s]
  double max_gyro_std = 0.1;       //!< above: the platform does not rest [rad/s] (YAML: deg/s)
  double max_accel_std = 1.0;      //!< above: the platform does not rest [m/s^2]
  double max_gyro_mean = 0.2;      //!< above: the platform does not rest [rad/s] (YAML: deg/s)
  double gravity = 9.81;           //!< |g| [m/s^2]
  bool align_with_gravity = true;  //!< world z axis up; false: world = first IMU frame (paper)
};

/** Group `imu`. */
struct ImuParameters
{
  ImuNoise noise;
  double max_gap = 0.5;       //!< longer gaps between samples are reported as a fault [s]
};

/** Group `lidar`. */
struct LidarParameters
{
  double min_range = 0.5;     //!< nearer points are dropped [m]
  double max_range = 150.0;   //!< farther points are dropped [m]
  double time_offset = 0.0;   //!< added to the LiDAR stamps [s]
  bool deskew = true;         //!< motion compensation (eq. 9-10)
};

/** Group `reduction`. */
struct ReductionParameters
{
  double voxel_size = 0.5;    //!< grid that keeps one point per voxel for the update [m]
  int max_points = 0;         //!< at most so many points in the update; 0 = no limit
};

/** Group `measurement`. */
struct MeasurementParameters
{
  double range_noise = 0.02;        //!< standard deviation of a range [m]
};

/** Group `map`. */
struct MapParameters
{
  double radius = 150.0;      //!< points farther from the sensor than this may be dropped [m]
};

/** Everything that configures an Odometry. */
struct Parameters
{
  InitializationParameters initialization;
  ImuParameters imu;
  LidarParameters lidar;
  ReductionParameters reduction;
  MeasurementParameters measurement;
  MapParameters map;
  IterationLimits update;
  GainForm gain = GainForm::Information;
  int threads = 0;            //!< worker threads; 0 = all cores
};

}  // namespace fastlio
