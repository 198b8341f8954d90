// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file topic_list.h A list of the inputs' content, for people. */
#pragma once

#include "command_line.h"
#include <fastlio/survey/input_plan.h>

#include <map>
#include <string>
#include <vector>

namespace fastlio
{
/** Findings about the inputs before they are read as a whole. */
struct ImportPlan
{
  SensorSurvey survey;
  std::map<std::string, LidarPlan> lidars;  //!< of point clouds, by label
};

/** Looks at the beginning of the inputs. */
[[nodiscard]] ImportPlan planImport(const ImportArguments& arguments);

/** Lines: topics of each input with counts and reasons; reads all of it. */
[[nodiscard]] std::string listTopics(const ImportArguments& arguments, const ImportPlan& plan);

/** Lines: the meaning of the times of points, and its source. */
[[nodiscard]] std::string describeTimes(const ImportPlan& plan);

}  // namespace fastlio
