// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fast_lio_keys.h"

#include "config_problems.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace fastlio;
using namespace fastlio::testing;

// Who comes from FAST_LIO gives its file first.
TEST(FastLioKeys, AFileOfFastLioIsToldWhatTakesThePlaceOfEachKey)
{
  const std::string problem = problemOf(
      "common:\n  lid_topic: '/livox/lidar'\npreprocess:\n  blind: 4\nmapping:\n"
      "  acc_cov: 0.1\n  extrinsic_T: [0.04, 0.02, -0.03]\n  unheard_of: 1\nmax_iteration: 3\n");
  expectContains(
      problem,
      "line 2, common.lid_topic: is a parameter of FAST_LIO; here: input.lidar_sensor_label");
  expectContains(
      problem, "line 4, preprocess.blind: is a parameter of FAST_LIO; here: lidar.min_range");
  expectContains(
      problem, "line 6, mapping.acc_cov: is a parameter of FAST_LIO; here: imu.accel_noise");
  expectContains(
      problem, "line 7, mapping.extrinsic_T: is a parameter of FAST_LIO; here: input.T_");
  expectContains(problem, "line 8, mapping.unheard_of: is not a parameter; did you mean");
  expectContains(problem, "line 9, max_iteration: is a parameter of FAST_LIO; here: update.max_");
}

TEST(FastLioKeys, AFileOfFastLioForRos2AsWell)
{
  for (const std::string node : {"/**", "laser_mapping"})
  {
    const std::string begin = node + ":\n  ros__parameters:\n";
    expectContains(
        problemOf(begin + "    preprocess:\n      blind: 4\n"),
        "line 4, preprocess.blind: is a parameter of FAST_LIO; here: lidar.min_range");
    expectContains(
        problemOf(begin + "    preprocess.blind: 4\n"),
        "blind: is a parameter of FAST_LIO; here: lidar.min_range");
  }
}

TEST(FastLioKeys, ASettingOfFastLioIsToldWhatTakesItsPlace)
{
  Config config;
  const std::string problem =
      messageOf<std::invalid_argument>([&] { (void)applySetting("blind=4", config); });
  EXPECT_EQ(problem, "--set 'blind=4': 'blind' is a parameter of FAST_LIO; here: lidar.min_range");
  expectContains(
      messageOf<std::invalid_argument>([&] { (void)applySetting("rest.map_time=4", config); }),
      "is a constant of the method now");
  expectContains(
      messageOf<std::invalid_argument>([&] { (void)applySetting("rest.interval=4", config); }),
      "is not a parameter; did you mean");
}

TEST(FastLioKeys, LeadToParametersThatThereAre)
{
  const std::regex parameter("[a-z0-9]+\\.[A-Za-z_]+");
  for (const FastLioKey& key : fastLioKeys())
  {
    EXPECT_EQ(findOption(configTable(), std::string(key.name)), nullptr);
    const std::string advice(key.instead);
    const bool needs_none = advice.rfind("nothing: ", 0) == 0;
    std::sregex_iterator named(advice.begin(), advice.end(), parameter);
    EXPECT_TRUE(needs_none || named != std::sregex_iterator()) << advice;
    for (; named != std::sregex_iterator(); ++named)
    {
      const bool is_file = named->str() == "trajectory.tum";
      EXPECT_TRUE(is_file || findOption(configTable(), named->str()) != nullptr) << named->str();
    }
  }
}

TEST(FastLioKeys, AreThoseOfTheDocument)
{
  std::ifstream file(std::string(FASTLIO_SOURCE_DIR) + "/docs/from_fast_lio.md");
  std::ostringstream text;
  text << file.rdbuf();
  for (const FastLioKey& key : fastLioKeys())
    expectContains(
        text.str(), "| `" + std::string(key.name) + "` | " + std::string(key.instead) + " |\n");
}
