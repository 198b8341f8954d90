// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file info_report.h A surveyed recording for people and for programs. */
#pragma once

#include <fastlio/survey/recording_survey.h>

#include <string>

namespace fastlio
{
[[nodiscard]] std::string toTable(const RecordingSurvey& survey);
[[nodiscard]] std::string toJson(const RecordingSurvey& survey);

}  // namespace fastlio
