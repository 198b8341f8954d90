// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sensor_selection.h Which LiDAR and which IMU of a recording to use. */
#pragma once

#include <fastlio/filter/pose.h>
#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/sweep_time.h>
#include <fastlio/mrpt_bridge/rawlog_source.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** What a sensor is to the odometry. */
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
  std::vector<PointTimeSample> point_times;  //!< time fields, one per scan; points 0: no times
  bool times_by_sensor = false;              //!< the class itself says when each point was measured
  SweepShape sweep;                          //!< of a cloud without times
  /** @} */
};

/** Every sensor seen; problems that reading met. */
struct SensorSurvey
{
  std::vector<SensorSummary> sensors;  //!< in order of first appearance
  std::vector<ReadProblem> problems;
};

/** Regular expressions (ECMAScript, the whole label must match); empty: any. */
struct SensorPatterns
{
  std::string lidar_label;
  std::string imu_label;
  std::vector<std::string> further_lidar_labels = {};  //!< of LiDARs beside the first
};

/** The sensors to use. */
struct SensorSelection
{
  SensorSummary lidar;
  SensorSummary imu;
  std::vector<SensorSummary> ignored;
  std::vector<SensorSummary> further_lidars;  //!< in the order of the patterns
};

/** Looks at the recording until usable sensors that match have been seen, LiDARs in several scans,
 * and \a at_least [s] of it have passed; at all of it when there are none. */
[[nodiscard]] SensorSurvey surveySensors(
    const std::vector<std::string>& files, const SensorPatterns& patterns, double at_least = 2.0);

/** A survey while observations come in: takes one in. */
void noteObservation(SensorSurvey& survey, const mrpt::obs::CObservation& observation);

/** Usable sensors that match have been seen, LiDARs in several scans. */
[[nodiscard]] bool isComplete(const SensorSurvey& survey, const SensorPatterns& patterns);

/** Of several that match, the one with most observations is taken.
 * \exception std::invalid_argument a pattern is not a regular expression
 * \exception std::runtime_error no usable LiDAR or IMU matches: lists what there is, and says what
 * the files' own trouble was */
[[nodiscard]] SensorSelection selectSensors(
    const SensorSurvey& survey, const SensorPatterns& patterns);

/** Several lines for people: what is used, what is not. */
[[nodiscard]] std::string describe(const SensorSelection& selection);

/** One line for people. */
[[nodiscard]] std::string describe(const SensorSummary& sensor);

}  // namespace fastlio
