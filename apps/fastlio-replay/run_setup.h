// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_setup.h From the command line to everything that a run needs, checked. */
#pragma once

#include "command_line.h"
#include "output_places.h"
#include <fastlio/config/config.h>
#include <fastlio/localmap/saved_map.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/run/run_summary.h>
#include <fastlio/survey/input_plan.h>
#include <fastlio/survey/sensor_selection.h>

#include <optional>
#include <string>

namespace fastlio
{
/** A run that can start. */
struct RunSetup
{
  ReplayArguments arguments;
  Config config;
  OutputPlan outputs;
  std::string configuration;  //!< where the configuration comes from, for people
  SensorSelection selection;
  InputPlan plan;
  OutputFrame frame;
  std::optional<SavedMap> saved_map;  //!< to start in
};

/** The configuration that the arguments ask for as YAML, each value with its origin
 * (--dump-config). \exception Failure the file cannot be used */
[[nodiscard]] std::string dumpedConfig(const ReplayArguments& arguments);

/** Loads the configuration, checks the output places, looks for the sensors, in this order.
 * \exception Failure with the exit status to end with */
[[nodiscard]] RunSetup setUpRun(const ReplayArguments& arguments);

}  // namespace fastlio
