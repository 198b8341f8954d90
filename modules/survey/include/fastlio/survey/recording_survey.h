// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_survey.h A recording looked at as a whole, without running the odometry. */
#pragma once

#include <fastlio/interface/odometry_options.h>
#include <fastlio/survey/imu_survey.h>
#include <fastlio/survey/input_plan.h>
#include <fastlio/survey/lidar_look.h>
#include <fastlio/survey/lidar_models.h>
#include <fastlio/survey/motion_check.h>
#include <fastlio/survey/stamp_report.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** One sensor label. */
struct SurveyedSensor
{
  SensorSummary summary;
  StampReport stamps;
};

/** A LiDAR that is used. */
struct SurveyedLidar
{
  std::size_t index = 0;  //!< in RecordingSurvey::sensors
  LidarPlan plan;
  LidarLook look;
  PresetMatch preset;
};

/** Whether stamps of LiDAR and IMU are of the same time. */
struct ClockOverlap
{
  double seconds = 0;   //!< that both sensors cover; negative: the time between them
  double fraction = 0;  //!< of the LiDAR's time, 0..1
  double lead = 0;  //!< median of LiDAR stamp minus the newest IMU stamp before it in the file [s]
};

/** Everything. */
struct RecordingSurvey
{
  std::vector<std::string> files;
  std::vector<ReadProblem> problems;
  std::vector<SurveyedSensor> sensors;  //!< in order of first appearance
  std::string unusable;                 //!< why fastlio-replay cannot run; empty: it can
  /** \name If there are a LiDAR and an IMU
   * @{ */
  std::optional<std::size_t> imu_index;  //!< in sensors
  std::vector<SurveyedLidar> lidars;     //!< the first, then the further ones
  ImuSurvey imu;
  ClockOverlap overlap;
  std::optional<MotionCheck> motion;
  double rotation_error = 0;  //!< between R_imu_lidar of motion and of the recording [rad]
  std::vector<std::string> notes, warnings;
  /** @} */
};

struct SurveyOptions
{
  bool check_motion = true;
  /** Fraction of the work that is done, 0..1. */
  std::function<void(double)> progress;
};

/** Reads the recording twice. Never throws for what files contain.
 * \exception std::invalid_argument no files, or options that no recording can satisfy */
[[nodiscard]] RecordingSurvey surveyRecording(
    const std::vector<std::string>& files, const SensorOptions& sensors = {},
    const OdometryOptions& odometry = {}, const SurveyOptions& options = {});

}  // namespace fastlio
