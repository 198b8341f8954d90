// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sensor_options.h Which sensors of a recording are used, where they are mounted, and what
 * the times of their points mean. */
#pragma once

#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/sweep_time.h>
#include <fastlio/math/pose.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace fastlio
{
/** Groups `lidar_2`, `lidar_3`, `lidar_4`: LiDARs beside the first one; their points join its
 * scans. */
struct FurtherLidarOptions
{
  std::string sensor_label;             //!< regular expression; empty: there is none
  std::optional<Pose> T_vehicle_lidar;  //!< LiDAR in the vehicle frame, instead of the recording's
  double time_offset = 0.0;             //!< added to its stamps [s]
};

/** How many of them there may be. */
constexpr std::size_t kMostFurtherLidars = 3;

/** Group `input`: which sensors of a recording are used, and where they are mounted. For
 * whoever feeds the odometry. */
struct SensorOptions
{
  std::string lidar_sensor_label;       //!< regular expression; empty: found automatically
  std::string imu_sensor_label;         //!< regular expression; empty: found automatically
  std::optional<Pose> T_vehicle_imu;    //!< IMU in the vehicle frame, instead of the recording's
  std::optional<Pose> T_vehicle_lidar;  //!< LiDAR in the vehicle frame, instead of the recording's
  /** Mounting of a built-in IMU as the maker gives it: LiDAR in the IMU frame. For recordings
   * without the poses of these two sensors, and only without the two T above. */
  std::optional<Pose> factory_T_imu_lidar;
  PointTimeUnit point_time_unit = PointTimeUnit::Auto;
  PointTimeReference point_time_reference = PointTimeReference::Auto;
  MissingPointTimes missing_point_times = MissingPointTimes::Auto;
  double sweep_start = 3.14159265358979323846;  //!< azimuth where a revolution begins [rad]
  std::array<FurtherLidarOptions, kMostFurtherLidars> further_lidars;
};

}  // namespace fastlio
