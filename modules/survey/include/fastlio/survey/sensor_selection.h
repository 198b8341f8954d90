// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sensor_selection.h Which LiDAR and which IMU of a recording to use. */
#pragma once

#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/sensor_summary.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** Sensors that a survey distinguishes: more than any vehicle has, few enough to look through. */
inline constexpr std::size_t kMostSensors = 1000;

/** Every sensor seen; problems that reading met. */
struct SensorSurvey
{
  std::vector<SensorSummary> sensors;  //!< in order of first appearance
  std::vector<ReadProblem> problems;
  std::size_t observations_beyond = 0;  //!< of sensors after kMostSensors, which are left out
};

/** Regular expressions (label_pattern.h, the whole label must match); empty: any. */
struct SensorPatterns
{
  std::string lidar_label;
  std::string imu_label;
  std::vector<std::string> further_lidar_labels = {};  //!< of LiDARs beside the first
};

/** Looks at the recording until usable sensors that match have been seen, LiDARs in several scans
 * with points, and \a at_least [s] of it have passed; at all of it when there are none. */
[[nodiscard]] SensorSurvey surveySensors(
    const std::vector<std::string>& files, const SensorPatterns& patterns, double at_least = 2.0);

/** A survey while observations come in: takes one in. \return the sensor's index; nothing when the
 * observation is left out, without a stamp or of a sensor after kMostSensors */
std::optional<std::size_t> noteObservation(
    SensorSurvey& survey, const mrpt::obs::CObservation& observation);

/** Usable sensors that match have been seen, LiDARs in several scans with points. */
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
