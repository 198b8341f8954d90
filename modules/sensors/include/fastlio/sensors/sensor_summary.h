// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sensor_summary.h The sensors of a recording, and those that are used. */
#pragma once

#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/sweep_time.h>
#include <fastlio/math/pose.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** The role of a sensor in the odometry. */
enum class SensorKind
{
  Lidar,
  Imu,
  Other
};

/** One sensor label of a recording, as far as it was looked at. */
struct SensorSummary
{
  std::string label;       //!< CObservation::sensorLabel, may be empty
  std::string class_name;  //!< e.g. mrpt::obs::CObservationVelodyneScan
  std::string detail;      //!< model, point fields or channels; says why a sensor is not usable
  SensorKind kind = SensorKind::Other;
  bool usable = false;    //!< as LiDAR or IMU of the odometry
  Pose T_vehicle_sensor;  //!< sensorPose of its first observation
  std::size_t observations = 0;
  std::int64_t first_stamp_ns = 0, last_stamp_ns = 0;

  /** \name Of LiDARs
   * @{ */
  std::size_t scans_with_points = 0;
  std::vector<PointTimeSample> point_times;  //!< time fields, one per scan; points 0: no times
  bool times_by_sensor = false;              //!< the class itself says when each point was measured
  SweepShape sweep;                          //!< of a cloud without times
  /** @} */
};

/** The sensors to use. */
struct SensorSelection
{
  SensorSummary lidar;
  SensorSummary imu;
  std::vector<SensorSummary> ignored;
  std::vector<SensorSummary> further_lidars;  //!< in the order of the patterns
};

}  // namespace fastlio
