// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "replay_test_support.h"

#include <nlohmann/json.hpp>
#include <sstream>

namespace fastlio::testing
{
namespace
{
using Json = nlohmann::json;
using CommandLine = ReplayTest;
using Configuration = ReplayTest;
using BadInput = ReplayTest;

TEST_F(CommandLine, HelpTellsOptionsAndExitStatus)
{
  const auto result = replay({"--help"});
  EXPECT_EQ(result.exit_status, 0);
  for (const auto* text :
       {"--config", "--input-rawlog", "--output-dir", "--output-tum-path", "--lidar-sensor-label",
        "--imu-sensor-label", "--skip-first-n", "--only-first-n", "--frame", "--threads",
        "--verbosity", "--version", "130  interrupted"})
    EXPECT_NE(result.output.find(text), std::string::npos) << text;
}

TEST_F(CommandLine, VersionIsPrinted)
{
  expectEnd(replay({"--version"}), 0, "fastlio-replay ");
}

TEST_F(CommandLine, MistakesAreExplained)
{
  expectEnd(replay({}), 1, "fastlio-replay walk.rawlog");
  expectEnd(replayFile("x", {"--no-such-option"}), 1, "--no-such-option");
  expectEnd(replayFile("x", {"--treads", "2"}), 1, "did you mean '--threads'");
  expectEnd(replayFile("x", {"--frame", "camera"}), 1, "vehicle");
  expectEnd(replayFile("x", {"--threads", "many"}), 1, "--threads");
  expectEnd(replayFile("x", {"-v", "LOUD"}), 1, "LOUD");
  expectEnd(replayFile("x", {"--skip-first-n", "-3"}), 1, "--skip-first-n");
}

TEST_F(Configuration, DumpsLoadBackAndTellOrigins)
{
  const std::string config = write("c.yaml", "lidar:\n  max_range: 50\ngain: standard\n");
  const auto dump = replay({"-c", config, "--threads", "3", "--dump-config"});
  EXPECT_EQ(dump.exit_status, 0) << dump.output;
  for (const std::string& text :
       {"  max_range: 50  # " + config + ", line 2\n", "gain: standard  # " + config + ", line 3\n",
        std::string("threads: 3  # command line, --threads\n"),
        std::string("  min_range: 0.5  # default\n")})
    EXPECT_NE(dump.output.find(text), std::string::npos) << text << dump.output;
  const auto again = replay({"-c", write("dump.yaml", dump.output), "--dump-config"});
  EXPECT_EQ(again.exit_status, 0) << again.output;
  const auto values = [](std::string text)
  {
    std::string plain;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      plain += line.substr(0, line.find("  # ")) + "\n";
    return plain;
  };
  EXPECT_EQ(values(again.output), values(dump.output));
  const auto main = replay({"-c", config, "--dump-config", "main"});
  EXPECT_NE(main.output.find("gain: standard"), std::string::npos) << main.output;
  EXPECT_EQ(main.output.find("deskew"), std::string::npos) << main.output;
  expectEnd(replay({"--dump-config", "everything"}), 1, "--dump-config");
}

TEST_F(Configuration, MissingFileIsNamed)
{
  expectEnd(replayFile(record("a.rawlog", {}), {"-c", file("no.yaml")}), 1, file("no.yaml"));
}

TEST_F(Configuration, UnknownKeyNamesTheNearest)
{
  const std::string config = write("c.yaml", "lidar:\n  max_rnge: 50\n");
  expectEnd(replayFile(record("a.rawlog", {}), {"-c", config}), 1, "max_range");
  EXPECT_FALSE(std::filesystem::exists(file("out/summary.json")));
}

TEST_F(Configuration, WrongTypeIsReported)
{
  const std::string config = write("c.yaml", "lidar:\n  max_range: far\n");
  expectEnd(replayFile(record("a.rawlog", {}), {"-c", config}), 1, "far");
}

TEST_F(Configuration, UnwritableOutputIsFoundBeforeTheRun)
{
  const std::string blocker = write("blocker", "a file");
  const auto result =
      replay({"--input-rawlog", record("a.rawlog", {}), "--output-dir", blocker + "/out"});
  expectEnd(result, 1, blocker);
  EXPECT_EQ(result.output.find("tracking"), std::string::npos);
}

TEST_F(BadInput, MissingFile)
{
  const auto result = replayFile(file("no.rawlog"));
  expectEnd(result, 2, "the recording '" + file("no.rawlog") + "' does not exist");
  EXPECT_EQ(result.output.find("--input-rawlog"), std::string::npos) << result.output;
}

TEST_F(BadInput, Folder)
{
  expectEnd(replayFile(file("")), 2, "is a folder in which no recording was found");
}

TEST_F(BadInput, NotARawlog)
{
  expectEnd(replayFile(write("a.rawlog", std::string(5000, 'x'))), 2, "a.rawlog");
  expectEnd(replayFile(write("empty.rawlog", "")), 2, "empty.rawlog");
}

TEST_F(BadInput, TruncatedKeepsWhatCouldBeRead)
{
  BoxRecording recording;
  recording.seconds = 8.0;
  const std::string whole = contentOf(record("whole.rawlog", recording));
  const std::string cut = write("cut.rawlog", whole.substr(0, whole.size() * 3 / 4));
  expectEnd(replayFile(cut), 3, "cut.rawlog");
  expectAllFiles();
  EXPECT_GE(linesOf(file("out/trajectory.tum")), 30U);
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["exit_status"], 3);
  EXPECT_FALSE(summary["input"]["problems"].empty());
}

TEST_F(BadInput, CorruptInTheMiddleKeepsWhatCouldBeRead)
{
  BoxRecording recording;
  recording.seconds = 8.0;
  std::string content = contentOf(record("whole.rawlog", recording));
  for (std::size_t i = content.size() * 3 / 4; i < content.size() * 3 / 4 + 2000; ++i)
    content[i] = static_cast<char>(i * 31);
  expectEnd(replayFile(write("corrupt.rawlog", content)), 3, "corrupt.rawlog");
  expectAllFiles();
  EXPECT_GE(linesOf(file("out/trajectory.tum")), 30U);
}

TEST_F(BadInput, MissingSecondPartKeepsNothingWaiting)
{
  const std::string first = record("a.rawlog", {});
  const auto result = replay(
      {"--input-rawlog", first, "--input-rawlog", file("b.rawlog"), "--output-dir", file("out")});
  expectEnd(result, 2, file("b.rawlog"));
}

TEST_F(BadInput, NoImu)
{
  BoxRecording recording;
  recording.with_imu = false;
  expectEnd(replayFile(record("a.rawlog", recording)), 2, "IMU");
}

TEST_F(BadInput, NoLidar)
{
  BoxRecording recording;
  recording.with_lidar = false;
  expectEnd(replayFile(record("a.rawlog", recording)), 2, "LiDAR");
}

TEST_F(BadInput, ImuWithoutAcceleration)
{
  BoxRecording recording;
  recording.with_accelerometer = false;
  expectEnd(replayFile(record("a.rawlog", recording)), 2, "accel");
}

TEST_F(BadInput, LabelThatNothingMatches)
{
  const auto result =
      replayFile(record("a.rawlog", {}), {"--lidar-sensor-label", "velodyne_front"});
  expectEnd(result, 2, "'lidar'");
}

TEST_F(BadInput, LabelThatIsNoRegularExpression)
{
  expectEnd(replayFile(record("a.rawlog", {}), {"--imu-sensor-label", "imu["}), 1, "imu[");
}

TEST_F(BadInput, PlatformThatNeverRests)
{
  BoxRecording recording;
  recording.shake_amplitude = 2.0;
  expectEnd(replayFile(record("a.rawlog", recording)), 4, "never initialised");
  expectAllFiles();
}

TEST_F(BadInput, EmptyScansAndInvalidPointsAreCounted)
{
  BoxRecording recording;
  recording.rotten_points = true;
  expectEnd(replayFile(record("a.rawlog", recording)), 0, "scans_empty");
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["input"]["counts"]["scans_empty"], 4);
  EXPECT_GT(summary["input"]["counts"]["points_invalid"], 5000);
  EXPECT_EQ(summary["scans"]["diverged"], 0);
}

TEST_F(BadInput, ScansWithoutPointsAreNotATroubleOfTheClocks)
{
  BoxRecording recording;
  recording.view_covered = true;
  expectEnd(replayFile(record("a.rawlog", recording)), 4, "none of the 40 scans has a point");
}

TEST_F(BadInput, PointTimesThatCanBeReadInTwoWaysAreAnError)
{
  BoxRecording recording;
  recording.times_per_second = 5.0;
  const std::string rawlog = record("a.rawlog", recording);
  const auto result = replayFile(rawlog);
  expectEnd(result, 2, "read as s a scan lasts 0.4958 s");
  expectEnd(result, 2, "read as ms a scan lasts 0.0004958 s");
  expectEnd(result, 2, "input.point_time_unit: s or ms");
  const std::string config = write("c.yaml", "input:\n  point_time_unit: ms\n");
  expectEnd(replayFile(rawlog, {"-c", config}), 0, "point times are ms after the stamp");
}

TEST_F(BadInput, PointTimesThatAreMissingAreSaidLoudly)
{
  BoxRecording recording;
  recording.point_times = false;
  const std::string rawlog = record("a.rawlog", recording);
  const auto result = replayFile(rawlog, {"-v", "WARN"});
  expectEnd(result, 0, "turns counter-clockwise");
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["input"]["counts"]["scans_with_synthetic_point_times"], 40);
  EXPECT_EQ(summary["input"]["counts"]["scans_without_point_times"], 0);
  const std::string config = write("c.yaml", "input:\n  missing_point_times: none\n");
  const auto none = replayFile(rawlog, {"-c", config, "-v", "WARN"});
  expectEnd(none, 0, "no motion compensation");
  expectEnd(none, 0, "40 scans_without_point_times");
}

TEST_F(BadInput, LidarThatStartsLater)
{
  BoxRecording recording;
  recording.seconds = 8.0;
  recording.lidar_starts = 5.0;
  expectEnd(replayFile(record("a.rawlog", recording)), 0, "exit status 0");
  EXPECT_GE(linesOf(file("out/trajectory.tum")), 28U);
}

TEST_F(BadInput, StampsThatJumpBackAreDroppedAndCounted)
{
  BoxRecording recording;
  recording.seconds = 6.0;
  recording.stamps_jump_back = true;
  expectEnd(replayFile(record("a.rawlog", recording)), 0, "imu_out_of_order");
  const Json summary = Json::parse(contentOf(file("out/summary.json")));
  EXPECT_GE(summary["input"]["counts"]["imu_out_of_order"], 8);
  EXPECT_GE(summary["input"]["counts"]["scans_out_of_order"], 3);
  EXPECT_EQ(summary["scans"]["diverged"], 0);
}

TEST_F(CommandLine, ValuesThatAreNoneNameTheChoices)
{
  for (const char* option : {"--skip-first-n", "--only-first-n"})
    expectEnd(replayFile("x", {option, "-1"}), 1, "must be a whole number, 0 or larger, not '-1'");
  expectEnd(
      replayFile("x", {"-v", "debugg"}), 1, "must be DEBUG, ERROR, INFO or WARN, not 'debugg'");
  expectEnd(replayFile(record("a.rawlog", {}), {"-v", "error"}), 0, "");
  expectEnd(
      replayFile("x", {"--map-in", "m.ply", "--initial-pose", "1,2,3"}), 1,
      "must be six numbers X,Y,Z,YAW,PITCH,ROLL [m, deg] between commas, not '1,2,3'");
}

TEST_F(CommandLine, AReferenceThatIsNamedMustBeOne)
{
  const std::string rawlog = record("a.rawlog", {});
  expectEnd(replayFile(rawlog, {"--reference", file("typo.tum")}), 1, "typo.tum' does not exist");
  expectEnd(
      replayFile(rawlog, {"--reference", write("notes.tum", "no trajectory")}), 1,
      "notes.tum' cannot be used");
  EXPECT_FALSE(std::filesystem::exists(file("out"))) << "nothing was run";
}

TEST_F(BadInput, SkippingAllScansSaysSo)
{
  const auto result = replayFile(record("a.rawlog", {}), {"--skip-first-n", "5000"});
  expectEnd(result, 4, "--skip-first-n leaves out all 40 scans");
}

TEST_F(BadInput, PartsThatOverlapAreRefused)
{
  BoxRecording second;
  second.start = 2.0;
  const auto result = replay(
      {record("a.rawlog", {}), record("b.rawlog", second), "--join", "--output-dir", file("out")});
  expectEnd(result, 1, "overlap by 1.9");
  EXPECT_FALSE(std::filesystem::exists(file("out")));
}

}  // namespace
}  // namespace fastlio::testing
