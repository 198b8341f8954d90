// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rotation_by_motion.h"

#include <fastlio/math/angles.h>
#include <fastlio/survey/recording_survey.h>

namespace fastlio
{
namespace
{
// Calibrations that begin with an error of 9 deg find the right rotation, and what the motions show
// may be off by several degrees.
constexpr double kAboutTheSame = 10.0 * kRadPerDeg;
}  // namespace

std::optional<ShownRotation> contradictingRotation(
    const std::vector<CalibrationRecording>& recordings, const Config& config)
{
  for (const CalibrationRecording& recording : recordings)
  {
    const RecordingSurvey survey =
        surveyRecording(recording.files, config.sensors, config.odometry);
    if (!survey.motion || !survey.motion->rotation_known) continue;
    if (survey.rotation_error < kAboutTheSame) return std::nullopt;
    return ShownRotation{survey.motion->R_imu_lidar, survey.rotation_error};
  }
  return std::nullopt;
}

}  // namespace fastlio
