// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file simulated_walk.h A simulated recording, and the trajectory that a program makes of it. */
#pragma once

#include "process.h"
#include "test_files.h"
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace fastlio::testing
{
inline std::string bytesOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/** Everything that the test writes lies in its folder. */
class SimulatedWalk : public ::testing::Test
{
 protected:
  /** A few seconds of a walk. Both sensors are in the vehicle's origin: the containers of this test
   * hold no mounting. */
  std::string rawlogOf(const std::vector<std::pair<std::string, std::string>>& overrides = {})
  {
    SimulationSettings settings = defaultSettings("office");
    settings.duration = 4.0;
    settings = withSetting(settings, "lidar.pose", "0, 0, 0, 0, 0, 0");
    for (const auto& [key, value] : overrides)
      settings = withSetting(settings, key, value);
    return writeRecording(Simulation(settings), folder_.file("simulated")).rawlog;
  }

  static std::vector<Object> objectsOf(const std::string& rawlog)
  {
    std::vector<Object> objects;
    RawlogSource source({rawlog}, {0.0});
    while (auto observation = source.next())
      objects.push_back(std::move(observation));
    return objects;
  }

  std::string trajectoryOf(const std::string& recording)
  {
    const std::string file = folder_.file("trajectory.tum");
    const auto result =
        Process(
            {FASTLIO_REPLAY_PROGRAM, "--input-rawlog", recording, "--output-tum-path", file},
            folder_.file("log"))
            .wait();
    EXPECT_EQ(result.exit_status, 0) << result.output;
    return bytesOf(file);
  }

  std::string fileOf(const std::string& name, const std::string& bytes)
  {
    write(folder_.file(name), bytes);
    return folder_.file(name);
  }

  TemporaryFolder folder_;
};

}  // namespace fastlio::testing
