// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "replay_test_support.h"
#include <fastlio/files/atomic_file.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

namespace fastlio::testing
{
namespace
{
using Json = nlohmann::json;
using GoodInput = ReplayTest;
using Interruption = ReplayTest;

/** Positions of a TUM file. */
std::vector<std::array<double, 3>> positionsOf(const std::string& tum)
{
  std::istringstream in(tum);
  std::vector<std::array<double, 3>> positions;
  for (std::string line; std::getline(in, line);)
  {
    std::istringstream cells(line);
    double t = 0;
    std::array<double, 3> p{};
    cells >> t >> p[0] >> p[1] >> p[2];
    positions.push_back(p);
  }
  return positions;
}

TEST_F(GoodInput, RestingPlatformStaysWhereItIs)
{
  const auto result = replayFile(record("a.rawlog", {}));
  expectEnd(result, 0, "exit status 0");
  expectAllFiles();
  const auto positions = positionsOf(contentOf(file("out/trajectory.tum")));
  EXPECT_GE(positions.size(), 38U);  // scans of the resting start count, too
  EXPECT_LE(positions.size(), 40U);
  for (const auto& p : positions)
  {
    EXPECT_NEAR(p[0], 0.0, 0.02);
    EXPECT_NEAR(p[1], 0.0, 0.02);
    EXPECT_NEAR(p[2], -0.1, 0.02);  // the vehicle's origin is below the IMU, where the world starts
  }
}

TEST_F(GoodInput, SummaryTellsTheRun)
{
  ASSERT_EQ(replayFile(record("a.rawlog", {}), {"--threads", "1"}).exit_status, 0);
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["status"], "ok");
  EXPECT_EQ(summary["input"]["counts"]["scans"], 40);
  EXPECT_EQ(summary["input"]["counts"]["imu_samples"], 400);
  EXPECT_EQ(summary["scans"]["diverged"], 0);
  EXPECT_EQ(summary["scans"]["with_pose"], linesOf(file("out/trajectory.tum")));
  EXPECT_EQ(summary["parameters"]["threads"], 1);
  EXPECT_EQ(summary["frame"], "vehicle");
  for (const auto& output : summary["outputs"])
    EXPECT_EQ(output["bytes"], std::filesystem::file_size(output["path"].get<std::string>()));
}

TEST_F(GoodInput, ImuFrameStartsAtTheOrigin)
{
  ASSERT_EQ(replayFile(record("a.rawlog", {}), {"--frame", "imu"}).exit_status, 0);
  const auto positions = positionsOf(contentOf(file("out/trajectory.tum")));
  ASSERT_FALSE(positions.empty());
  EXPECT_NEAR(positions.front()[2], 0.0, 0.01);
}

TEST_F(GoodInput, TumPathAloneIsEnough)
{
  const auto result = replay(
      {"--input-rawlog", record("a.rawlog", {}), "--output-tum-path", file("new/folder/t.tum")});
  expectEnd(result, 0, file("new/folder/t.tum"));
  EXPECT_GE(linesOf(file("new/folder/t.tum")), 38U);
}

TEST_F(GoodInput, TumPathEqualToTheFolderOwnIsWrittenOnce)
{
  const auto result =
      replayFile(record("a.rawlog", {}), {"--output-tum-path", file("out/trajectory.tum")});
  expectEnd(result, 0, "exit status 0");
  expectAllFiles();
}

TEST_F(GoodInput, StatesAtTheRateOfTheImuOnRequest)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog).exit_status, 0);
  EXPECT_FALSE(std::filesystem::exists(file("out/imu_rate.csv")));
  const auto result = replayFile(rawlog, {"--imu-rate"});
  expectEnd(result, 0, "imu_rate.csv");
  // 100 Hz, from the first scan's begin to the last one's end; four lines of explanation
  EXPECT_NEAR(static_cast<double>(linesOf(file("out/imu_rate.csv"))), 393.0, 15.0);
  expectEnd(
      replay({"--input-rawlog", rawlog, "--output-tum-path", file("t.tum"), "--imu-rate"}), 1,
      "--output-dir");
}

TEST_F(GoodInput, NumberOfThreadsDoesNotChangeTheResult)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--threads", "1"}).exit_status, 0);
  const std::string one = contentOf(file("out/states.csv"));
  ASSERT_EQ(replayFile(rawlog, {"--threads", "3"}).exit_status, 0);
  EXPECT_EQ(contentOf(file("out/states.csv")), one);
}

TEST_F(GoodInput, SplitRecordingGivesTheSameAsTheWhole)
{
  ASSERT_EQ(replayFile(record("whole.rawlog", {})).exit_status, 0);
  const std::string whole = contentOf(file("out/trajectory.tum"));
  BoxRecording half;
  half.seconds = 2.0;
  const std::string first = record("part1.rawlog", half);
  half.start = 2.0;
  const std::string second = record("part2.rawlog", half);
  // Two seconds of rest only: nothing to track.
  ASSERT_EQ(replayFile(second, {"--set", "initialization.mode=rest"}).exit_status, 4);
  ASSERT_EQ(
      replay({"--input-rawlog", first, "--input-rawlog", second, "--output-dir", file("out")})
          .exit_status,
      0);
  const auto expected = positionsOf(whole);
  const auto split = positionsOf(contentOf(file("out/trajectory.tum")));
  ASSERT_EQ(split.size(), expected.size());
  for (std::size_t i = 0; i < split.size(); ++i)
    EXPECT_NEAR(split[i][0], expected[i][0], 0.02);
}

TEST_F(GoodInput, UnitOfThePointTimesDoesNotMatter)
{
  BoxRecording recording;
  ASSERT_EQ(replayFile(record("s.rawlog", recording)).exit_status, 0);
  const std::string seconds = contentOf(file("out/trajectory.tum"));
  recording.times_per_second = 1e9;
  const auto result = replayFile(record("ns.rawlog", recording));
  expectEnd(result, 0, "point times are ns after the stamp");
  const auto expected = positionsOf(seconds),
             positions = positionsOf(contentOf(file("out/trajectory.tum")));
  ASSERT_EQ(positions.size(), expected.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_NEAR(positions[i][0], expected[i][0], 1e-4);
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_NE(summary["input"]["sensors"].dump().find("ns after the stamp"), std::string::npos);
  const auto& poses = summary["input"]["sensor_poses"];
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0]["label"], "lidar");
  EXPECT_EQ(poses[0]["origin"], "none is given");
  EXPECT_EQ(poses[1]["sensor"], "IMU");
  EXPECT_NEAR(poses[1]["xyz_m"][2].get<double>(), 0.1, 1e-9);
  EXPECT_EQ(poses[1]["origin"], "the recording");
}

TEST_F(GoodInput, SkippingAndLimitingCountScans)
{
  BoxRecording recording;
  recording.seconds = 6.0;
  const auto result =
      replayFile(record("a.rawlog", recording), {"--skip-first-n", "10", "--only-first-n", "35"});
  expectEnd(result, 0, "exit status 0");
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["input"]["counts"]["scans_skipped"], 10);
  EXPECT_LE(summary["scans"]["processed"], 35);
  EXPECT_GE(summary["scans"]["processed"], 33);
  EXPECT_EQ(summary["time"]["begin"], "1700000001.000000000");
}

TEST_F(GoodInput, LabelsAndConfigurationAreHonoured)
{
  const std::string config = write("c.yaml", "lidar:\n  max_range: 4.0\n");
  const auto result = replayFile(
      record("a.rawlog", {}),
      {"-c", config, "--lidar-sensor-label", "li.*", "--imu-sensor-label", "imu"});
  expectEnd(result, 0, config);
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["parameters"]["lidar"]["max_range"], 4.0);
  EXPECT_EQ(summary["parameters"]["input"]["lidar_sensor_label"], "li.*");
  EXPECT_GT(summary["points"]["dropped_far"], 1000);
}

TEST_F(GoodInput, LogIsSparseWhenNotOnATerminal)
{
  const auto result = replayFile(record("a.rawlog", {}));
  EXPECT_EQ(result.output.find('\r'), std::string::npos);
  EXPECT_LT(std::count(result.output.begin(), result.output.end(), '\n'), 40) << result.output;
}

TEST_F(GoodInput, QuietAtErrorAndTalkativeAtDebug)
{
  const std::string rawlog = record("a.rawlog", {});
  EXPECT_EQ(replayFile(rawlog, {"-v", "ERROR"}).output, "");
  const auto debug = replayFile(rawlog, {"--verbosity", "DEBUG"});
  EXPECT_GT(std::count(debug.output.begin(), debug.output.end(), '\n'), 40) << debug.output;
}

/** Waits until rows of a file have reached the disk, so that the run is in its middle. */
bool waitForRows(const std::string& folder, const std::string& name)
{
  std::error_code error;
  for (int i = 0; i < 6000; ++i)
  {
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (isTemporaryOf(name, entry.path().filename().string()) && entry.file_size(error) > 0)
        return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

class InterruptionBy : public ReplayTest, public ::testing::WithParamInterface<int>
{
};

TEST_P(InterruptionBy, FinishesTheFiles)
{
  BoxRecording recording;
  recording.seconds = 100.0;
  const std::string rawlog = record("long.rawlog", recording);
  Process process(
      command(
          {"--input-rawlog", rawlog, "--output-dir", file("out"), "--threads", "1", "--imu-rate"}),
      file("log.txt"));
  ASSERT_TRUE(waitForRows(file("out"), "states.csv"));
  process.signal(GetParam());
  expectEnd(process.wait(), 130, "interrupted");
  expectAllFiles();
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(summary["scans"]["with_pose"], linesOf(file("out/trajectory.tum")));
  EXPECT_LT(summary["scans"]["processed"], 1000);
  EXPECT_GT(linesOf(file("out/imu_rate.csv")), linesOf(file("out/trajectory.tum")));
}

INSTANTIATE_TEST_SUITE_P(
    Signals, InterruptionBy, ::testing::Values(SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ));

}  // namespace
}  // namespace fastlio::testing
