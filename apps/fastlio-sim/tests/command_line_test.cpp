// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line_test.cpp fastlio-sim as users call it, with good and bad input. */

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <process.h>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using fastlio::testing::ProcessResult;

/** Runs the program in a directory of its own. */
class FastlioSim : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::temp_directory_path() /
                 ("fastlio_sim_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  [[nodiscard]] ProcessResult run(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(), FASTLIO_SIM_PROGRAM);
    return fastlio::testing::Process(arguments, path("log.txt")).wait();
  }

  [[nodiscard]] std::string path(const std::string& name) const { return directory_ / name; }

  [[nodiscard]] nlohmann::json truthOf(const std::string& directory) const
  {
    return nlohmann::json::parse(std::ifstream(path(directory) + "/scenario.json"));
  }

 private:
  fs::path directory_;
};

bool mentions(const ProcessResult& result, const std::string& text)
{
  return result.output.find(text) != std::string::npos;
}

TEST_F(FastlioSim, ListsWhatItCanDo)
{
  const ProcessResult help = run({"--help"});
  EXPECT_EQ(help.exit_status, 0);
  for (const char* option :
       {"--list", "--scenario", "--duration", "--seed", "--output-dir", "--set"})
    EXPECT_TRUE(mentions(help, option)) << option;
  EXPECT_TRUE(mentions(run({"--version"}), "fastlio-sim 0."));
  const ProcessResult list = run({"--list"});
  EXPECT_EQ(list.exit_status, 0);
  for (const char* name : {"campus", "office", "uav", "car", "shake", "spin", "stairs", "tunnel"})
    EXPECT_TRUE(mentions(list, name)) << name;
  const ProcessResult settings = run({"uav", "--list-settings"});
  EXPECT_EQ(settings.exit_status, 0);
  EXPECT_TRUE(mentions(settings, "lidar.kind = livox"));
  EXPECT_TRUE(mentions(settings, "imu.bits = 0"));
}

TEST_F(FastlioSim, WritesAllFilesAndNamesThem)
{
  const ProcessResult result =
      run({"--scenario", "office", "--duration", "3", "--stride", "20", "-o", path("out")});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  for (const char* file : {"recording.rawlog", "ground_truth.tum", "config.yaml", "scenario.json"})
  {
    EXPECT_TRUE(fs::exists(path("out") + "/" + file)) << file;
    EXPECT_TRUE(mentions(result, file)) << result.output;
  }
  EXPECT_EQ(truthOf("out")["duration_s"], 3.0);
}

TEST_F(FastlioSim, SettingsAreChangedByOptionsAndBySet)
{
  const ProcessResult result = run(
      {"rest", "--duration", "1", "--seed", "42", "--imu-rate", "400", "--scan-rate", "20",
       "--lidar", "os64", "--set", "lidar.columns=128", "--set", "imu.gyro_bias=0.1,0,-0.1", "-q",
       "-o", path("out")});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(result.output, "");
  const auto settings = truthOf("out")["settings"];
  EXPECT_EQ(settings["seed"], 42);
  EXPECT_EQ(settings["imu.rate"], 400.0);
  EXPECT_EQ(settings["lidar.rate"], 20.0);
  EXPECT_EQ(settings["lidar.kind"], "os64");
  EXPECT_EQ(settings["lidar.columns"], 128);
  EXPECT_EQ(settings["imu.gyro_bias"][2], -0.1);
}

TEST_F(FastlioSim, RealisticSensorsHaveErrorsThatOnlyTheScenarioTells)
{
  const ProcessResult result = run(
      {"campus", "--realistic", "--duration", "2", "--stride", "20", "--set",
       "lidar.false_returns=0", "-q", "-o", path("out")});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  const auto scenario = truthOf("out");
  const auto& truth = scenario["truth"];
  EXPECT_EQ(scenario["settings"]["imu.bits"], 16);
  EXPECT_EQ(scenario["settings"]["lidar.false_returns"], 0.0);
  EXPECT_EQ(truth["lidar_clock_minus_imu_clock_s"], 0.004);
  EXPECT_NE(truth["imu_errors"]["gyro_matrix"][0][0], 1.0);
  // lidar.pose is given, the truth is not.
  EXPECT_NE(truth["T_imu_lidar"]["position_m"][0], scenario["settings"]["lidar.pose"][0]);
}

TEST_F(FastlioSim, ReceiversOfGnssAreReported)
{
  const ProcessResult result = run(
      {"town", "--duration", "3", "--stride", "100", "--set", "gnss.rate=2", "--set",
       "gnss.latitude=36.5", "-q", "-o", path("out")});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(truthOf("out")["truth"]["gnss"]["datum"]["latitude_deg"], 36.5);
  EXPECT_EQ(truthOf("out")["counts"]["gnss_fixes"], 7);
}

TEST_F(FastlioSim, WrongNamesGetTheNearestOne)
{
  const ProcessResult scenario = run({"--scenario", "ofice", "-o", path("out")});
  EXPECT_EQ(scenario.exit_status, 1);
  EXPECT_TRUE(mentions(scenario, "'office'")) << scenario.output;
  const ProcessResult setting = run({"office", "--set", "imu.gyro_nose=1", "-o", path("out")});
  EXPECT_EQ(setting.exit_status, 1);
  EXPECT_TRUE(mentions(setting, "'imu.gyro_noise'")) << setting.output;
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(FastlioSim, WrongValuesAreRefusedWithWhatIsAllowed)
{
  using Arguments = std::vector<std::string>;
  for (const auto& arguments :
       {Arguments{"office", "--duration", "-3"}, Arguments{"office", "--imu-rate", "fast"},
        Arguments{"office", "--scan-rate", "0"}, Arguments{"office", "--lidar", "sonar"},
        Arguments{"office", "--set", "imu.rate"}, Arguments{"office", "--no-such-option"},
        Arguments{"office", "--set", "lidar.min_range=200"},
        Arguments{"town", "--set", "world.length=100"},
        Arguments{"town", "--set", "gnss.multipath=2"},
        Arguments{"town", "--set", "gnss.lever_arm=1,2"}, Arguments{}})
  {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_status, 1) << result.output;
    EXPECT_FALSE(result.output.empty());
  }
  EXPECT_TRUE(mentions(run({"office", "--duration", "-3"}), "allowed: 0 to"));
  EXPECT_TRUE(mentions(run({}), "campus"));
}

TEST_F(FastlioSim, DirectoriesThatCannotBeWrittenAreNamed)
{
  std::ofstream(path("file")) << "not a directory";
  const ProcessResult result = run({"rest", "--duration", "1", "-o", path("file") + "/out"});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_TRUE(mentions(result, path("file"))) << result.output;
}

TEST_F(FastlioSim, ReplacesItsOwnRecordingOnly)
{
  const std::vector<std::string> short_run = {"rest", "--duration", "1",        "--stride",
                                              "20",   "-o",         path("out")};
  const auto again = [&](const char* option)
  {
    std::vector<std::string> arguments = short_run;
    arguments.emplace_back(option);
    return run(arguments);
  };
  fs::create_directory(path("out"));
  std::ofstream(path("out/config.yaml")) << "# of the user";
  const ProcessResult refused = run(short_run);
  EXPECT_EQ(refused.exit_status, 1);
  EXPECT_TRUE(mentions(refused, path("out/config.yaml"))) << refused.output;
  EXPECT_EQ(fs::file_size(path("out/config.yaml")), 13U);
  EXPECT_FALSE(fs::exists(path("out/recording.rawlog")));
  EXPECT_EQ(again("--overwrite").exit_status, 0);
  EXPECT_EQ(again("--quiet").exit_status, 0);
}

TEST_F(FastlioSim, TwoOutputsAreTwoFiles)
{
  fs::create_directory(path("out"));
  fs::create_symlink("ground_truth.tum", path("out/recording.rawlog"));
  const ProcessResult result =
      run({"rest", "--duration", "1", "--stride", "20", "--overwrite", "-o", path("out")});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_TRUE(mentions(result, "are the same file")) << result.output;
  EXPECT_FALSE(fs::exists(path("out/config.yaml")));
}

TEST_F(FastlioSim, AnInterruptionLeavesNothingBehind)
{
  fastlio::testing::Process process(
      {FASTLIO_SIM_PROGRAM, "office", "-o", path("long"), "--duration", "600"}, path("log.txt"));
  const auto wait_until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!fs::exists(path("long")) && std::chrono::steady_clock::now() < wait_until)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(fs::exists(path("long")));
  process.signal(SIGINT);
  const ProcessResult result = process.wait();
  EXPECT_EQ(result.exit_status, 130) << result.output;
  EXPECT_TRUE(mentions(result, "nothing was written")) << result.output;
  EXPECT_FALSE(fs::exists(path("long")));
}
}  // namespace
