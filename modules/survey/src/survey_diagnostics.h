// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file survey_diagnostics.h Diagnostics of a surveyed recording. */
#pragma once

#include <fastlio/survey/recording_survey.h>

namespace fastlio
{
/** Adds to survey.notes and survey.warnings. */
void addRemarks(
    RecordingSurvey& survey, const SensorOptions& sensors, const OdometryOptions& odometry);

/** Angle between the vehicle's z axis and up, at rest [rad]. */
[[nodiscard]] double tiltOf(const RecordingSurvey& survey, const SensorOptions& sensors);

}  // namespace fastlio
