// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/sensors/sensor_option_table.h>

namespace fastlio
{
namespace
{
using Rows = OptionTable<SensorOptions>;

Rows inputRows()
{
  using O = SensorOptions;
  return {
      {"input.lidar_sensor_label", "", valueAs<RegexValue>(&O::lidar_sensor_label),
       "regular expression that the whole sensor label of the LiDAR matches; empty: found "
       "automatically",
       OptionTier::Main},
      {"input.imu_sensor_label", "", valueAs<RegexValue>(&O::imu_sensor_label),
       "regular expression that the whole sensor label of the IMU matches; empty: found "
       "automatically",
       OptionTier::Main},
      {"input.T_vehicle_imu", "m, deg", valueAs<OptionalPoseValue>(&O::T_vehicle_imu),
       "pose of the IMU in the vehicle frame as [x, y, z, yaw, pitch, roll]; null: the sensor pose "
       "of the recording",
       OptionTier::Main},
      {"input.T_vehicle_lidar", "m, deg", valueAs<OptionalPoseValue>(&O::T_vehicle_lidar),
       "pose of the LiDAR in the vehicle frame as [x, y, z, yaw, pitch, roll]; null: the sensor "
       "pose of the recording",
       OptionTier::Main},
      {"input.factory_T_imu_lidar", "m, deg", valueAs<OptionalPoseValue>(&O::factory_T_imu_lidar),
       "pose of the LiDAR in the frame of its built-in IMU as [x, y, z, yaw, pitch, roll]; used "
       "only where the recording gives neither sensor a pose and input.T_vehicle_imu and "
       "input.T_vehicle_lidar are null; the LiDAR's frame is the vehicle's then"},
      {"input.point_time_unit", "", choice(&O::point_time_unit, {"auto", "s", "ms", "us", "ns"}),
       "unit of the time of each point in point clouds; auto: from the data, and logged"},
      {"input.point_time_reference", "",
       choice(&O::point_time_reference, {"auto", "stamp", "start", "middle", "end", "absolute"}),
       "what the time of each point refers to; stamp: time = stamp of the scan + t, of either "
       "sign; start, middle, end: the stamp is the time of the first point, midway, of the last "
       "point, whatever t is there; absolute: t counts from 1970; auto: from the data, and logged"},
      {"input.missing_point_times", "",
       choice(&O::missing_point_times, {"auto", "none", "clockwise", "counterclockwise"}),
       "point clouds without times; auto: from the azimuth where the order of the points shows a "
       "whole revolution, else none; none: no motion compensation (also right for clouds that are "
       "compensated already); clockwise, counterclockwise: from the azimuth of a LiDAR that turns "
       "so seen from above, beginning at input.sweep_start; point_time_reference then says what "
       "the stamp is (auto: start)"},
      {"input.sweep_start", "deg", number(&O::sweep_start, -180.0, 180.0, kRadPerDeg),
       "azimuth where a revolution begins, counter-clockwise from the x axis; used with "
       "missing_point_times clockwise and counterclockwise"},
  };
}

/** Keys of a group in the order of its rows. */
using FurtherKeys = std::array<std::string_view, 3>;

template <std::size_t kIndex>
void addFurtherLidar(Rows& rows, const FurtherKeys& keys)
{
  rows.push_back(
      {keys[0], "",
       [](auto& o) -> OptionValue { return RegexValue{&o.further_lidars[kIndex].sensor_label}; },
       "regular expression that the whole sensor label of a further LiDAR matches, whose points "
       "join the scans of the first; empty: there is none"});
  rows.push_back(
      {keys[1], "m, deg",
       [](auto& o) -> OptionValue
       { return OptionalPoseValue{&o.further_lidars[kIndex].T_vehicle_lidar}; },
       "pose of this LiDAR in the vehicle frame as [x, y, z, yaw, pitch, roll]; null: the sensor "
       "pose of the recording"});
  rows.push_back(
      {keys[2], "s",
       [](auto& o) -> OptionValue {
         return RealValue{&o.further_lidars[kIndex].time_offset, -10.0, 10.0};
       },
       "added to the stamps of this LiDAR to bring them to the clock of the IMU, as "
       "lidar.time_offset is to those of the first"});
}

Rows allRows()
{
  Rows rows = inputRows();
  addFurtherLidar<0>(
      rows, {"lidar_2.sensor_label", "lidar_2.T_vehicle_lidar", "lidar_2.time_offset"});
  addFurtherLidar<1>(
      rows, {"lidar_3.sensor_label", "lidar_3.T_vehicle_lidar", "lidar_3.time_offset"});
  addFurtherLidar<2>(
      rows, {"lidar_4.sensor_label", "lidar_4.T_vehicle_lidar", "lidar_4.time_offset"});
  return rows;
}
}  // namespace

const OptionTable<SensorOptions>& sensorOptionTable()
{
  static const Rows table = allRows();
  return table;
}

}  // namespace fastlio
