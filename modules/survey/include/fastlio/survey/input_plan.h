// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file input_plan.h What is going to be done with the sensors of a recording: found in the data,
 * or told by parameters. */
#pragma once

#include <fastlio/odometry/parameters.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/survey/sensor_selection.h>

#include <string>
#include <vector>

namespace fastlio
{
/** How the points of one LiDAR get their times. */
struct LidarPlan
{
  PointTimeFinding finding;  //!< about the time field of its clouds
  CloudTiming timing;
  bool compensated = true;  //!< false: no point has a time of its own, no motion compensation
  std::string text;         //!< for people: where the times come from, with the numbers
  bool loud = false;        //!< text tells of something that people should look at
};

/** The plan for all sensors. */
struct InputPlan
{
  BridgeOptions bridge;
  std::vector<LidarPlan> lidars;      //!< the first LiDAR, then the further ones
  std::vector<std::string> notes;     //!< for people
  std::vector<std::string> warnings;  //!< for people, to be looked at
};

/** The labels that parameters ask for. */
[[nodiscard]] SensorPatterns patternsOf(const Parameters& parameters);

/** Decides for one LiDAR. An Ambiguous finding leaves the points without times.
 * \param sensor with what surveySensors() saw of its times */
[[nodiscard]] LidarPlan planLidar(const SensorSummary& sensor, const SensorOptions& parameters);

/** Decides for all of them.
 * \exception std::runtime_error times of points can be read in two ways: the message shows both and
 * says which parameter decides */
[[nodiscard]] InputPlan planInput(const SensorSelection& selection, const Parameters& parameters);

}  // namespace fastlio
