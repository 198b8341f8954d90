// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Usual command lines: recordings by themselves, parameters on the command line, several at once.

#include "replay_test_support.h"

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

class Typed : public ReplayTest
{
 protected:
  /** Runs in the test's folder. */
  [[nodiscard]] ProcessResult typed(const std::vector<std::string>& arguments) const
  {
    std::vector<std::string> words{
        "/bin/sh", "-c", R"(cd "$1" && shift && exec "$@")", "sh", file("")};
    const std::vector<std::string> program = command(arguments);
    words.insert(words.end(), program.begin(), program.end());
    return Process(words, file("log.txt")).wait();
  }
};

TEST_F(Typed, ARecordingAloneGetsAFolderOfItsOwn)
{
  (void)record("walk.rawlog", {});
  expectEnd(typed({"walk.rawlog"}), 0, "walk-run/trajectory.tum");
  EXPECT_TRUE(fs::exists(file("walk-run/report.html")));
  EXPECT_EQ(fs::read_symlink(file("latest")), "walk-run");
  const std::string first = contentOf(file("walk-run/trajectory.tum"));
  expectEnd(typed({"walk.rawlog"}), 0, "walk-run-2/trajectory.tum");
  EXPECT_EQ(fs::read_symlink(file("latest")), "walk-run-2");
  EXPECT_EQ(contentOf(file("walk-run/trajectory.tum")), first);
}

TEST_F(Typed, LatestReplacesNothingThatIsNoLink)
{
  (void)record("walk.rawlog", {});
  (void)write("latest", "mine");
  expectEnd(typed({"walk.rawlog"}), 0, "'latest' is no symbolic link");
  EXPECT_EQ(contentOf(file("latest")), "mine");
}

TEST_F(Typed, LatestStaysWhereItLeadsToSomethingThatIsNoRun)
{
  (void)record("walk.rawlog", {});
  fs::create_directory(file("photos"));
  (void)write("photos/summary.json", R"({"of": "another program"})");
  for (const char* target : {"photos", "nowhere", "../gone-run", "latest"})
  {
    fs::create_symlink(target, file("latest"));
    expectEnd(typed({"walk.rawlog"}), 0, "'latest' is a link to something that is no folder of a");
    EXPECT_EQ(fs::read_symlink(file("latest")), target);
    fs::remove(file("latest"));
  }
}

TEST_F(Typed, LatestLeavesARunThatWasMovedOrRemoved)
{
  (void)record("walk.rawlog", {});
  expectEnd(typed({"walk.rawlog"}), 0, "");
  fs::rename(file("walk-run"), file("best"));
  expectEnd(typed({"walk.rawlog"}), 0, "");
  EXPECT_EQ(fs::read_symlink(file("latest")), "walk-run") << "it led nowhere";
  fs::remove(file("latest"));
  fs::create_symlink("best", file("latest"));
  expectEnd(typed({"walk.rawlog"}), 0, "");
  EXPECT_EQ(fs::read_symlink(file("latest")), "walk-run-2");
  fs::remove_all(file("walk-run-2"));
  expectEnd(typed({"walk.rawlog", "--export", "trajectory"}), 0, "");
  EXPECT_EQ(fs::read_symlink(file("latest")), "walk-run-2");
}

TEST_F(Typed, AFailedRunLeavesNoFolder)
{
  expectEnd(typed({"missing.rawlog"}), 2, "missing.rawlog");
  EXPECT_FALSE(fs::exists(file("missing-run")));
  EXPECT_FALSE(fs::is_symlink(file("latest")));
}

TEST_F(Typed, SeveralRecordingsAreABatch)
{
  (void)record("a.rawlog", {});
  (void)record("b.rawlog", {});
  const auto result = typed({"a.rawlog", "missing.rawlog", "b.rawlog", "-o", "runs"});
  expectEnd(result, 2, "input unusable");
  EXPECT_TRUE(fs::exists(file("runs/a/trajectory.tum")));
  EXPECT_TRUE(fs::exists(file("runs/b/trajectory.tum"))) << "a failure does not end the batch";
  EXPECT_FALSE(fs::exists(file("runs/missing")));
  EXPECT_EQ(contentOf(file("runs/a/trajectory.tum")), contentOf(file("runs/b/trajectory.tum")));
  expectEnd(typed({"a.rawlog", "b.rawlog", "--output-tum-path", "t.tum"}), 1, "--output-tum-path");
}

TEST_F(Typed, RecordingsOfTheSameNameGetDifferentFolders)
{
  fs::create_directory(file("x"));
  (void)record("walk.rawlog", {});
  (void)record("x/walk.rawlog", {});
  expectEnd(typed({"walk.rawlog", "x/walk.rawlog", "-o", "runs"}), 0, "runs/walk-2");
  EXPECT_TRUE(fs::exists(file("runs/walk/summary.json")));
  EXPECT_TRUE(fs::exists(file("runs/walk-2/summary.json")));
}

TEST_F(Typed, FilesThatFollowEachOtherAreOneRecording)
{
  (void)record("whole.rawlog", {});
  BoxRecording half;
  half.seconds = 2.0;
  (void)record("walk_1.rawlog", half);
  half.start = 2.0;
  (void)record("walk_2.rawlog", half);
  expectEnd(typed({"whole.rawlog", "-o", "whole"}), 0, "");
  expectEnd(typed({"walk_2.rawlog", "walk_1.rawlog", "-o", "out"}), 0, "parts of one recording");
  EXPECT_EQ(linesOf(file("out/trajectory.tum")), linesOf(file("whole/trajectory.tum")));
  expectEnd(typed({"walk_1.rawlog", "walk_2.rawlog"}), 0, "walk_1-run");
  // The second half rests to its end: nothing to begin with.
  expectEnd(typed({"walk_1.rawlog", "walk_2.rawlog", "--no-join", "-o", "runs"}), 0, "runs/walk_2");
  expectEnd(typed({"walk_1.rawlog", "walk_2.rawlog", "--no-join", "--join"}), 1, "--join");
}

TEST_F(Typed, PartsAreJoinedWhenAsked)
{
  (void)record("a.rawlog", {});
  expectEnd(typed({"a.rawlog", "a.rawlog", "--join", "-o", "out"}), 1, "given twice");
  expectEnd(typed({"a.rawlog", "--input-rawlog", "a.rawlog", "-o", "out"}), 1, "--input-rawlog");
}

TEST_F(Typed, SetGoesOverTheFile)
{
  const std::string config = write("c.yaml", "map:\n  radius: 50\n");
  const auto dump = typed({"-c", config, "--set", "map.radius=60", "--dump-config"});
  expectEnd(dump, 0, "--set");
  EXPECT_NE(dump.output.find("radius: 60"), std::string::npos) << dump.output;
  expectEnd(
      typed({"--set", "map.radius=60", "--set", "map.voxel_size=0.3", "--dump-config"}), 0,
      "voxel_size: 0.3");
  expectEnd(typed({"--set", "map.radios=60", "--dump-config"}), 1, "did you mean 'map.radius'");
  expectEnd(typed({"--set", "map.radius", "--dump-config"}), 1, "KEY=VALUE");
  expectEnd(typed({"--set", "map.radius=-1", "--dump-config"}), 1, "out of range");
  (void)record("a.rawlog", {});
  expectEnd(typed({"--set", "map.radius=60", "--export", "trajectory", "a.rawlog"}), 0, "a-run/");
  expectEnd(typed({"a.rawlog", "--set", "lidar.min_range=200", "-o", "out"}), 1, "lidar.min_range");
}

TEST_F(Typed, QuietSaysNothingButErrors)
{
  (void)record("a.rawlog", {});
  const auto result = typed({"a.rawlog", "-q", "-o", "out"});
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.output, "");
  expectEnd(typed({"missing.rawlog", "-q", "-o", "out2"}), 2, "missing.rawlog");
}
}  // namespace
/** A recording whose labels name a sensor, and nothing says where it is mounted. */
BoxRecording labelled(const std::string& lidar, const std::string& imu)
{
  BoxRecording recording;
  recording.lidar_label = lidar;
  recording.imu_label = imu;
  recording.imu_height = 0.0;
  return recording;
}

TEST_F(Typed, TheDefaultsAreThoseOfTheSensorThatTheRecordingNames)
{
  (void)record("walk.rawlog", labelled("OS2-64", "os2_imu"));
  const auto alone = typed({"walk.rawlog", "-o", "alone"});
  expectEnd(alone, 0, "params/ouster_os2.yaml are in use");
  expectEnd(alone, 0, "measurement.range_noise: 0.03");
  expectEnd(alone, 0, "(input.factory_T_imu_lidar)");
  const std::string yaml = FASTLIO_PARAMS_DIR "/ouster_os2.yaml";
  expectEnd(
      typed({"walk.rawlog", "-o", "given", "-c", yaml}), 0, "they are the defaults, or given");
  EXPECT_EQ(contentOf(file("alone/covariance.csv")), contentOf(file("given/covariance.csv")));
  const std::string set = "measurement.range_noise=0.025";
  expectEnd(
      typed({"walk.rawlog", "--set", set, "--dump-config", "main"}), 0,
      "range_noise: 0.025  # --set");
  expectEnd(
      typed({"walk.rawlog", "--set", set, "--dump-config", "main"}), 0,
      "max_range: 240  # preset ouster_os2");
}

TEST_F(Typed, AMakersNameIsNoModelAndAnotherImuIsNotBuiltIn)
{
  (void)record("walk.rawlog", labelled("livox", "imu"));
  const auto maker = typed({"walk.rawlog", "-o", "maker"});
  EXPECT_EQ(maker.exit_status, 0);
  EXPECT_EQ(maker.output.find("params/"), std::string::npos) << maker.output;
  (void)record("other.rawlog", labelled("os2", "xsens"));
  const auto other = typed({"other.rawlog", "-o", "other"});
  expectEnd(other, 0, "params/ouster_os2.yaml are in use");
  EXPECT_EQ(other.output.find("factory"), std::string::npos) << other.output;
}

}  // namespace fastlio::testing
