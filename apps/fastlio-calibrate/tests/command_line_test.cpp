// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The program on simulated recordings: good and bad command lines, and a file that runs.

#include "process.h"
#include "recorded_once.h"
#include "temporary_folder.h"
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

namespace fastlio::testing
{
namespace
{
class Calibrate : public ::testing::Test
{
 protected:
  std::string record(const std::string& name, unsigned seed = 1)
  {
    SimulationSettings settings = defaultSettings("office");
    settings.duration = 12.0;
    settings.seed = seed;
    settings.lidar.stride = 4;
    return recordedOnce(settings, folder_.file(name));
  }

  ProcessResult run(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), FASTLIO_CALIBRATE_PROGRAM);
    return Process(arguments, folder_.file("log.txt")).wait();
  }

  std::string textOf(const std::string& path)
  {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  TemporaryFolder folder_;
};

TEST_F(Calibrate, WritesParametersThatAReplayTakes)
{
  const std::string rawlog = record("walk"), yaml = folder_.file("rig.yaml");
  const auto result =
      run({rawlog, "-o", yaml, "--passes", "2", "--json", folder_.file("rig.json")});
  ASSERT_TRUE(result.exit_status == 0 || result.exit_status == 6) << result.output;
  EXPECT_NE(result.output.find("LiDAR in the IMU frame, x"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("On "), std::string::npos) << "the trial";
  const auto json = nlohmann::json::parse(textOf(folder_.file("rig.json")));
  EXPECT_EQ(json["values"].size(), 13U + 1U + 4U) << "the rig, the incidence, the noise";
  EXPECT_GT(json["beams"].size(), 10U);
  EXPECT_TRUE(json["trial"]["better"].is_boolean());
  for (const auto& [name, value] : json["values"].items())
    if (value["std"].is_null())
      EXPECT_FALSE(value["advice"].get<std::string>().empty()) << name;
    else
      EXPECT_GT(value["std"].get<double>(), 0.0) << name;
  const auto replay = Process(
                          {FASTLIO_REPLAY_PROGRAM, "-c", yaml, "--input-rawlog", rawlog,
                           "--output-dir", folder_.file("out")},
                          folder_.file("replay.txt"))
                          .wait();
  EXPECT_EQ(replay.exit_status, 0) << replay.output;
}

TEST_F(Calibrate, AReplayCalibratesFirst)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 15.0;
  settings.lidar.stride = 4;
  settings = withSetting(settings, "lidar.laser_range_std", "0.02");
  settings = withSetting(settings, "imu.gyro_scale_std", "0.01");
  const std::string rawlog = writeRecording(Simulation(settings), folder_.file("walk")).rawlog;
  const auto replay = Process(
                          {FASTLIO_REPLAY_PROGRAM, "--calibrate", "--input-rawlog", rawlog,
                           "--output-dir", folder_.file("out")},
                          folder_.file("replay.txt"))
                          .wait();
  EXPECT_EQ(replay.exit_status, 0) << replay.output;
  const std::string summary = textOf(folder_.file("out/summary.json"));
  EXPECT_NE(summary.find("Calibration (--calibrate): On "), std::string::npos);
  EXPECT_NE(summary.find("use it."), std::string::npos) << replay.output;
  const auto parameters = nlohmann::json::parse(summary)["parameters"];
  EXPECT_GT(parameters["lidar"]["beam_offsets"].size(), 10U) << parameters.dump();
}

TEST_F(Calibrate, QuietAndWithoutTrial)
{
  const std::string rawlog = record("walk"), yaml = folder_.file("rig.yaml");
  const auto result = run({rawlog, "-q", "--no-trial", "-o", yaml, "--passes", "2"});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(result.output, "");
  EXPECT_NE(textOf(yaml).find("T_vehicle_lidar"), std::string::npos);
}

TEST_F(Calibrate, ATruncatedRecordingIsUsedAndReported)
{
  const std::string rawlog = record("walk"), yaml = folder_.file("rig.yaml");
  std::filesystem::resize_file(rawlog, std::filesystem::file_size(rawlog) * 3 / 4);
  const auto result = run({rawlog, "-q", "--no-trial", "-o", yaml, "--passes", "2"});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_NE(result.output.find("(the rest is used)"), std::string::npos) << result.output;
  EXPECT_TRUE(std::filesystem::exists(yaml));
}

TEST_F(Calibrate, RefusesToReplaceItsInput)
{
  const std::string rawlog = record("walk");
  const auto size = std::filesystem::file_size(rawlog);
  const auto result = run({rawlog, "-o", rawlog});
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_NE(result.output.find("--output"), std::string::npos) << result.output;
  EXPECT_EQ(std::filesystem::file_size(rawlog), size);
}

TEST_F(Calibrate, SaysWhatIsWrong)
{
  EXPECT_EQ(run({}).exit_status, 1);
  EXPECT_EQ(run({"a.rawlog", "--passes", "1"}).exit_status, 1);
  const auto missing = run({folder_.file("missing.rawlog"), "-o", folder_.file("x.yaml")});
  EXPECT_EQ(missing.exit_status, 2);
  EXPECT_NE(missing.output.find("missing.rawlog' does not exist"), std::string::npos)
      << missing.output;
  EXPECT_EQ(missing.output.find("LiDAR"), std::string::npos) << missing.output;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("x.yaml")));
  const std::string rawlog = record("walk");
  EXPECT_EQ(run({rawlog, rawlog}).exit_status, 1) << "the same recording twice";
  for (const std::string& name : {folder_.file(""), folder_.file("missing/c.yaml")})
  {
    const auto unwritable = run({rawlog, "-o", name});
    EXPECT_EQ(unwritable.exit_status, 1) << unwritable.output;
    EXPECT_EQ(unwritable.output.find("LiDAR"), std::string::npos) << "before the work";
  }
}

TEST_F(Calibrate, AFileOfSomebodyIsNotReplacedUnlessAsked)
{
  const std::string rawlog = record("walk"), yaml = folder_.file("own.yaml");
  const std::vector<std::string> words = {rawlog, "-q", "--no-trial", "--passes", "2", "-o", yaml};
  std::ofstream(yaml) << "map:\n  voxel_size: 0.3\n";
  const std::string before = textOf(yaml);
  const auto refused = run(words);
  EXPECT_EQ(refused.exit_status, 1) << refused.output;
  EXPECT_NE(refused.output.find("own.yaml' is there already"), std::string::npos) << refused.output;
  EXPECT_NE(refused.output.find("--overwrite"), std::string::npos) << refused.output;
  EXPECT_EQ(textOf(yaml), before);
  std::vector<std::string> overwriting = words;
  overwriting.emplace_back("--overwrite");
  EXPECT_EQ(run(overwriting).exit_status, 0);
  EXPECT_NE(textOf(yaml), before);
  EXPECT_EQ(run(words).exit_status, 0) << "its own file";
}

TEST_F(Calibrate, RecordingsOfTwoRigsAreRefused)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 5.0;
  settings.lidar.stride = 4;
  const auto other = withSetting(settings, "lidar.pose", "[0.3, 0, 0, 0, 0, 0]");
  const auto drone = withSetting(settings, "lidar.kind", "os64");
  const std::string first = writeRecording(Simulation(settings), folder_.file("a")).rawlog;
  for (const auto& [name, different, what] :
       {std::tuple{"b", other, "its LiDAR sits at [0.3, 0, 0, 0, 0, 0]"},
        std::tuple{"c", drone, "its LiDAR is mrpt::obs::CObservationPointCloud"}})
  {
    const std::string second = writeRecording(Simulation(different), folder_.file(name)).rawlog;
    const auto result = run({first, second, "--passes", "2", "-o", folder_.file("x.yaml")});
    EXPECT_EQ(result.exit_status, 2) << result.output;
    EXPECT_NE(result.output.find("is of another rig than"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find(what), std::string::npos) << result.output;
    EXPECT_FALSE(std::filesystem::exists(folder_.file("x.yaml")));
  }
}

TEST_F(Calibrate, AFailedTrialSaysWhatToDo)
{
  // What is given is the truth: nothing can be better.
  const std::string rawlog = record("walk"), yaml = folder_.file("rig.yaml");
  const auto result = run({rawlog, "-o", yaml, "--passes", "2"});
  ASSERT_EQ(result.exit_status, 6) << result.output;
  EXPECT_NE(
      result.output.find("Do not use " + yaml + "; keep the parameters that you had."),
      std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find(" prior std  unit"), std::string::npos) << result.output;
}

TEST_F(Calibrate, JsonGoesToStandardOutputWhenAsked)
{
  const std::string rawlog = record("walk");
  const auto result =
      run({rawlog, "--no-trial", "-o", folder_.file("rig.yaml"), "--passes", "2", "--json", "-"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(nlohmann::json::parse(result.output)["values"].size(), 18U);
}

/** It would count twice. */
TEST_F(Calibrate, ACopyOfARecordingIsRefused)
{
  const std::string first = record("a"), copy = folder_.file("copy.rawlog");
  std::filesystem::copy_file(first, copy);
  const auto result = run({first, copy, "--no-join", "-o", folder_.file("rig.yaml")});
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_NE(result.output.find("is a copy of"), std::string::npos) << result.output;
}

TEST_F(Calibrate, PartsThatOverlapAreRefused)
{
  const std::string first = record("a"), second = record("b", 2);
  const auto result = run({first, second, "--join", "-o", folder_.file("rig.yaml")});
  EXPECT_EQ(result.exit_status, 1) << result.output;
  EXPECT_NE(result.output.find("overlap by "), std::string::npos) << result.output;
}
}  // namespace
}  // namespace fastlio::testing
