// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file observation_bridge.h MRPT observations of the selected sensors to what the odometry takes.
 */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/sensors/sensor_summary.h>

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** How one LiDAR is converted. */
struct LidarConversion
{
  std::optional<Pose> T_imu_lidar;  //!< replaces what both sensorPoses give
  CloudTiming timing;               //!< of its point clouds
  std::int64_t stamp_shift_ns = 0;  //!< added to its stamps, to fit those of the first LiDAR
};

struct BridgeOptions
{
  std::optional<Pose> T_vehicle_imu;    //!< replaces the sensorPose of the IMU's observations
  std::vector<LidarConversion> lidars;  //!< the first one, then the further ones of the selection
  double further_min_range = 0.0;  //!< nearer points of the further ones are the platform's [m]
};

/** Counts of used and dropped observations; returns are counted over all scans. */
struct BridgeStatistics
{
  std::size_t imu_converted = 0;
  std::size_t imu_no_acceleration = 0, imu_no_angular_rate = 0, imu_not_finite = 0,
              imu_no_stamp = 0;

  std::size_t scans_converted = 0;
  std::size_t scans_synthetic_point_times = 0;  //!< times of points from their azimuth
  std::size_t scans_without_point_times = 0;    //!< converted, but no deskewing
  std::size_t scans_unusable_point_times = 0;   //!< of those: a time field that makes no sense
  std::size_t scans_no_stamp = 0;
  std::size_t scans_unreadable = 0;  //!< see last_error

  std::size_t points_converted = 0;
  std::size_t points_of_further = 0;  //!< of those: of LiDARs beside the first one
  std::size_t points_left_out = 0;    //!< of those: no scan of the first one is near in time
  std::size_t points_no_return = 0;
  std::size_t points_out_of_range = 0;
  std::size_t points_invalid = 0;  //!< NaN, infinite, at the origin, of an impossible time
  std::size_t points_duplicate = 0;
  std::size_t packet_blocks_corrupt = 0;
  std::size_t packet_times_corrupt = 0;

  std::size_t other_sensors = 0;  //!< observations of labels that are not selected
  std::string last_error;         //!< why the last unreadable scan was
};

/** std::monostate: nothing for the odometry, statistics() has the reason. */
using BridgeOutput = std::variant<std::monostate, ImuSample, LidarScan>;

/** Converts the observations of the selected LiDARs and IMU; counts the others. Never throws for
 * data. Not thread-safe. Scans of several LiDARs come out one by one, see ScanMerger. */
class ObservationBridge
{
 public:
  explicit ObservationBridge(SensorSelection selection, const BridgeOptions& options = {});

  [[nodiscard]] BridgeOutput convert(const mrpt::obs::CObservation& observation);

  /** Which LiDAR an observation is of: 0 the first, then the further ones; nothing: none of them.
   */
  [[nodiscard]] std::optional<std::size_t> lidarOf(
      const mrpt::obs::CObservation& observation) const;

  [[nodiscard]] const BridgeStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const SensorSelection& selection() const { return selection_; }

  /** IMU frame to vehicle frame. */
  [[nodiscard]] const Pose& T_vehicle_imu() const { return T_vehicle_imu_; }

 private:
  BridgeOutput convertImu(const mrpt::obs::CObservation& observation);
  BridgeOutput convertScan(const mrpt::obs::CObservation& observation, std::size_t lidar);
  [[nodiscard]] Pose extrinsicOf(
      const mrpt::obs::CObservation& observation, const LidarConversion& lidar) const;

  SensorSelection selection_;
  std::vector<LidarConversion> lidars_;
  double further_min_range_;
  Pose T_vehicle_imu_;
  BridgeStatistics statistics_;
};

}  // namespace fastlio
