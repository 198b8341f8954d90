// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file observation_bridge.h MRPT observations of the selected sensors to what the odometry takes.
 */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/mrpt_bridge/sensor_selection.h>

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

namespace fastlio
{
struct BridgeOptions
{
  std::optional<Pose> T_vehicle_imu;  //!< replaces the sensorPose of the IMU's observations
  std::optional<Pose> T_imu_lidar;    //!< replaces what both sensorPoses give
};

/** What became of the observations; returns are counted over all scans. */
struct BridgeStatistics
{
  std::size_t imu_converted = 0;
  std::size_t imu_no_acceleration = 0, imu_no_angular_rate = 0, imu_not_finite = 0,
              imu_no_stamp = 0;

  std::size_t scans_converted = 0;
  std::size_t scans_without_point_times = 0;   //!< converted, but no deskewing
  std::size_t scans_unusable_point_times = 0;  //!< of those: a time field that makes no sense
  std::size_t scans_no_stamp = 0;
  std::size_t scans_unreadable = 0;  //!< see last_error

  std::size_t points_converted = 0;
  std::size_t points_no_return = 0;
  std::size_t points_out_of_range = 0;
  std::size_t points_invalid = 0;  //!< NaN, infinite, at the origin
  std::size_t points_duplicate = 0;
  std::size_t packet_blocks_corrupt = 0;
  std::size_t packet_times_corrupt = 0;

  std::size_t other_sensors = 0;  //!< observations of labels that are not selected
  std::string last_error;         //!< why the last unreadable scan was
};

/** std::monostate: nothing for the odometry, statistics() tells why. */
using BridgeOutput = std::variant<std::monostate, ImuSample, LidarScan>;

/** Converts the observations of the selected LiDAR and IMU; counts the others. Never throws for
 * data. Not thread-safe. */
class ObservationBridge
{
 public:
  explicit ObservationBridge(SensorSelection selection, BridgeOptions options = {});

  [[nodiscard]] BridgeOutput convert(const mrpt::obs::CObservation& observation);

  [[nodiscard]] const BridgeStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const SensorSelection& selection() const { return selection_; }

  /** IMU frame to vehicle frame. */
  [[nodiscard]] const Pose& T_vehicle_imu() const { return T_vehicle_imu_; }

 private:
  BridgeOutput convertImu(const mrpt::obs::CObservation& observation);
  BridgeOutput convertScan(const mrpt::obs::CObservation& observation);
  [[nodiscard]] Pose extrinsicOf(const mrpt::obs::CObservation& observation) const;

  SensorSelection selection_;
  BridgeOptions options_;
  Pose T_vehicle_imu_;
  BridgeStatistics statistics_;
};

}  // namespace fastlio
