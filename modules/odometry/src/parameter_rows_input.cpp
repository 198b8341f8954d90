// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

#include <array>

namespace fastlio
{
namespace
{
/** Keys of a group in the order of its rows. */
using FurtherKeys = std::array<std::string_view, 3>;

template <std::size_t kIndex>
void addFurtherLidar(ParameterRows& rows, const FurtherKeys& keys)
{
  rows.push_back(
      {keys[0], "", RegexValue{[](auto& p) { return &p.further_lidars[kIndex].sensor_label; }},
       "regular expression that the whole sensor label of a further LiDAR matches, whose points "
       "join the scans of the first; empty: there is none"});
  rows.push_back(
      {keys[1], "m, deg",
       PoseValue{[](auto& p) { return &p.further_lidars[kIndex].T_vehicle_lidar; }},
       "pose of this LiDAR in the vehicle frame as [x, y, z, yaw, pitch, roll]; null: the sensor "
       "pose of the recording"});
  rows.push_back(
      {keys[2], "s",
       RealValue{[](auto& p) { return &p.further_lidars[kIndex].time_offset; }, -10.0, 10.0},
       "added to the stamps of this LiDAR to bring them to the clock of the IMU, as "
       "lidar.time_offset is to those of the first"});
}
}  // namespace

ParameterRows inputRows()
{
  return {
      {"input.lidar_sensor_label", "",
       RegexValue{[](auto& p) { return &p.input.lidar_sensor_label; }},
       "regular expression that the whole sensor label of the LiDAR matches; empty: found "
       "automatically"},
      {"input.imu_sensor_label", "", RegexValue{[](auto& p) { return &p.input.imu_sensor_label; }},
       "regular expression that the whole sensor label of the IMU matches; empty: found "
       "automatically"},
      {"input.T_vehicle_imu", "m, deg", PoseValue{[](auto& p) { return &p.input.T_vehicle_imu; }},
       "pose of the IMU in the vehicle frame as [x, y, z, yaw, pitch, roll]; null: the sensor pose "
       "of the recording"},
      {"input.T_vehicle_lidar", "m, deg",
       PoseValue{[](auto& p) { return &p.input.T_vehicle_lidar; }},
       "pose of the LiDAR in the vehicle frame as [x, y, z, yaw, pitch, roll]; null: the sensor "
       "pose of the recording"},
      {"input.point_time_unit", "",
       enumeration(
           [](auto& p) { return &p.input.point_time_unit; }, {"auto", "s", "ms", "us", "ns"}),
       "unit of the time of each point in point clouds; auto: found from the data, and said"},
      {"input.point_time_reference", "",
       enumeration(
           [](auto& p) { return &p.input.point_time_reference; },
           {"auto", "stamp", "start", "middle", "end", "absolute"}),
       "what the time of each point refers to; stamp: time = stamp of the scan + t, of either "
       "sign; start, middle, end: the stamp is the time of the first point, midway, of the last "
       "point, whatever t is there; absolute: t counts from 1970; auto: found from the data, and "
       "said"},
      {"input.missing_point_times", "",
       enumeration(
           [](auto& p) { return &p.input.missing_point_times; },
           {"auto", "none", "clockwise", "counterclockwise"}),
       "point clouds without times; auto: from the azimuth where the order of the points shows a "
       "whole revolution, else none; none: no motion compensation (also right for clouds that are "
       "compensated already); clockwise, counterclockwise: from the azimuth of a LiDAR that turns "
       "so seen from above, beginning at input.sweep_start; point_time_reference then says what "
       "the stamp is (auto: start)"},
      {"input.sweep_start", "deg",
       RealValue{[](auto& p) { return &p.input.sweep_start; }, -180.0, 180.0, kRadPerDeg},
       "azimuth where a revolution begins, counter-clockwise from the x axis; used with "
       "missing_point_times clockwise and counterclockwise"},
  };
}

ParameterRows furtherLidarRows()
{
  ParameterRows rows;
  addFurtherLidar<0>(
      rows, {"lidar_2.sensor_label", "lidar_2.T_vehicle_lidar", "lidar_2.time_offset"});
  addFurtherLidar<1>(
      rows, {"lidar_3.sensor_label", "lidar_3.T_vehicle_lidar", "lidar_3.time_offset"});
  addFurtherLidar<2>(
      rows, {"lidar_4.sensor_label", "lidar_4.T_vehicle_lidar", "lidar_4.time_offset"});
  return rows;
}

}  // namespace fastlio
