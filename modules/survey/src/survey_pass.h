// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file survey_pass.h The two readings of a recording that surveyRecording() makes (internal). */
#pragma once

#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/survey/lidar_look.h>
#include <fastlio/survey/motion_check.h>
#include <fastlio/survey/sensor_selection.h>

#include <functional>
#include <string>
#include <vector>

namespace fastlio
{
using SurveyProgress = std::function<void(double fraction)>;

/** The results of the first reading; one entry per sensor. */
struct FirstPass
{
  SensorSurvey survey;
  std::vector<std::vector<std::int64_t>> stamps;  //!< in the order of the files
  std::vector<std::vector<ImuSample>> samples;    //!< of IMUs, ascending stamps
  std::vector<std::vector<double>> leads;  //!< of LiDARs: stamp minus newest IMU stamp before [s]
};

[[nodiscard]] FirstPass readFirst(
    const std::vector<std::string>& files, const SurveyProgress& progress);

/** The results of the second reading. */
struct SecondPass
{
  std::vector<LidarLook> looks;  //!< the first LiDAR, then the further ones
  std::vector<ScanTurn> turns;
  Pose T_imu_lidar;  //!< of the first LiDAR, as it is given
};

/** \param lively stamps of scans of the first LiDAR to be matched; ends before it begins: none */
[[nodiscard]] SecondPass readSecond(
    const std::vector<std::string>& files, ObservationBridge bridge, const ScanSpan& lively,
    const SurveyProgress& progress);

}  // namespace fastlio
