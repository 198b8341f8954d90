// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file config_proposal.h A parameter file that follows from a recording (--write-config). */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/survey/recording_survey.h>

#include <string>

namespace fastlio
{
/** The few keys that follow from the recording, each with the reason as a comment, as YAML to be
 * edited. What a user has to know and the recording does not hold stands at the top.
 * \param given parameters that are kept as they are */
[[nodiscard]] std::string proposedConfig(const RecordingSurvey& survey, const Config& given);

}  // namespace fastlio
