// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_fixture.h Runs the program on simulated walks. */
#pragma once

#include "process.h"
#include "recorded_once.h"
#include "temporary_folder.h"
#include <fastlio/scenarios/settings_table.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace fs = std::filesystem;

class Map : public ::testing::Test
{
 protected:
  /** A walk on the campus: one loop takes 106 s. */
  static SimulationSettings walk(double duration)
  {
    SimulationSettings settings = defaultSettings("campus");
    settings.duration = duration;
    settings.speed = 3.0;
    settings.lidar.stride = 6;
    return settings;
  }

  /** A part of the same walk by other sensors. */
  static SimulationSettings anotherDay(double duration)
  {
    SimulationSettings settings = walk(duration);
    settings.seed = 9;
    return withSetting(settings, "path_start", "20");
  }

  std::string record(const std::string& name, const SimulationSettings& settings)
  {
    return recordedOnce(settings, folder_.file(name));
  }

  ProcessResult run(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), FASTLIO_MAP_PROGRAM);
    return Process(arguments, folder_.file("log.txt")).wait();
  }

  nlohmann::json summaryOf(const std::string& name)
  {
    return nlohmann::json::parse(contentOf(folder_.file(name) + "/summary.json"));
  }

  TemporaryFolder folder_;
};

}  // namespace fastlio::testing
