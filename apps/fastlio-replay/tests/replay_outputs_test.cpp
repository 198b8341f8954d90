// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "replay_test_support.h"

#include <csignal>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <thread>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;

// Programs in the shell: $1 is fastlio-replay, $2 the recording, $3 the output folder.
constexpr const char* kUnderNohup =
    R"(trap '' HUP; exec "$1" --input-rawlog "$2" --output-dir "$3" --threads 1)";
constexpr const char* kInFolder =
    R"(cd "$4" && exec "$1" --input-rawlog "$2" --output-dir "$3" --output-tum-path t.tum)";
constexpr const char* kReadBriefly =
    R"("$1" -v DEBUG --threads 1 --input-rawlog "$2" --output-dir "$3" 2>&1 | head -n 3)";
constexpr const char* kWithSmallFiles =
    R"(ulimit -f 40; exec "$1" --input-rawlog "$2" --output-dir "$3")";

/** Runs whose outputs meet what is there already. */
class Outputs : public ReplayTest
{
 protected:
  /** The run is refused, the message has both texts, and the file is as it was. */
  void expectRefusal(
      const std::vector<std::string>& arguments, const std::string& precious,
      const std::string& one, const std::string& other) const
  {
    const std::string before = contentOf(precious);
    const auto result = replay(arguments);
    expectEnd(result, 1, one);
    expectEnd(result, 1, other);
    EXPECT_EQ(result.output.find("tracking"), std::string::npos) << result.output;
    EXPECT_TRUE(contentOf(precious) == before) << precious << " has changed";
    EXPECT_EQ(namesIn(file("out")).find("trajectory"), std::string::npos);
  }

  /** A run of a hundred seconds, in its middle. */
  [[nodiscard]] std::unique_ptr<Process> longRun(const std::string& log) const
  {
    BoxRecording recording;
    recording.seconds = 100.0;
    auto process = std::make_unique<Process>(
        command(
            {"--input-rawlog", record("long.rawlog", recording), "--output-dir", file("out"),
             "--threads", "1"}),
        file(log));
    for (int i = 0; i < 6000 && namesIn(file("out")).find("map.ply") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return process;
  }
};

TEST_F(Outputs, ATrajectoryIsNoRecording)
{
  const std::string rawlog = record("a.rawlog", {});
  fs::create_symlink("a.rawlog", file("soft"));
  fs::create_hard_link(rawlog, file("hard"));
  for (const char* name : {"a.rawlog", "soft", "hard", "./a.rawlog"})
    expectRefusal(
        {"--input-rawlog", rawlog, "--output-tum-path", file(name)}, rawlog,
        "'" + file(name) + "' (--output-tum-path)", "'" + rawlog + "' (--input-rawlog)");
  expectRefusal(
      {"--input-rawlog", file("soft"), "--input-rawlog", rawlog, "--output-dir", file("out"),
       "--output-tum-path", rawlog},
      rawlog, rawlog, "--input-rawlog");
}

TEST_F(Outputs, NoFileOfTheFolderIsAnInput)
{
  fs::create_directory(file("out"));
  const std::string rawlog = record("out/odometry.rawlog", {});
  expectRefusal(
      {"--input-rawlog", rawlog, "--output-dir", file("out"), "--export", "rawlog", "--overwrite"},
      rawlog, "(--output-dir)", "(--input-rawlog)");
  const std::string config = write("out/states.csv", "threads: 1\n");
  expectRefusal(
      {"--input-rawlog", rawlog, "--output-dir", file("out"), "-c", config, "--overwrite"}, config,
      "(--output-dir)", "(--config)");
  const std::string map = write("out/map.ply", "ply\n");
  expectRefusal(
      {"--input-rawlog", rawlog, "--output-dir", file("out"), "--map-in", map, "--overwrite",
       "--export", "ply"},
      map, "(--output-dir)", "(--map-in)");
}

TEST_F(Outputs, NothingIsWrittenAmongTheExternalFilesOfARecording)
{
  const std::string rawlog = record("a.rawlog", {});
  fs::create_directory(file("a_Images"));
  const std::string cloud = write("a_Images/cloud.bin", "points");
  expectRefusal(
      {"--input-rawlog", rawlog, "--output-tum-path", cloud}, cloud, cloud, file("a_Images"));
  expectRefusal(
      {"--input-rawlog", rawlog, "--output-dir", file("a_Images/out")}, cloud, file("a_Images"),
      rawlog);
}

TEST_F(Outputs, TwoOutputsAreTwoFiles)
{
  fs::create_directory(file("out"));
  const std::string old = write("t.tum", "old");
  fs::create_hard_link(old, file("out/map.ply"));
  expectEnd(
      replayFile(record("a.rawlog", {}), {"--output-tum-path", old, "--overwrite"}), 1,
      "are the same file");
  EXPECT_EQ(contentOf(old), "old");
}

TEST_F(Outputs, TheTrajectoryAsItsOnlyFileMayLieInTheFolder)
{
  const auto result = replayFile(
      record("a.rawlog", {}),
      {"--output-tum-path", file("out/trajectory.tum"), "--export", "timing"});
  expectEnd(result, 0, "trajectory.tum");
  EXPECT_EQ(namesIn(file("out")), "summary.json timing.csv trajectory.tum");
}

TEST_F(Outputs, DevicesAndPipesAreWrittenTo)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = contentOf(file("pipe")); });
  expectEnd(replayFile(rawlog, {"--output-tum-path", file("pipe")}), 0, "pipe");
  reader.join();
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
  EXPECT_EQ(received, contentOf(file("out/trajectory.tum")));

  EXPECT_EQ(replay({"--input-rawlog", rawlog, "--output-tum-path", "/dev/null"}).exit_status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));

  // The log of the test is a regular file: what goes to /dev/stdout joins it.
  const auto printed = replay({"--input-rawlog", rawlog, "--output-tum-path", "/dev/stdout"});
  EXPECT_EQ(printed.exit_status, 0);
  EXPECT_NE(printed.output.find(received), std::string::npos) << printed.output;
  EXPECT_NE(printed.output.find("exit status 0"), std::string::npos) << printed.output;
}

TEST_F(Outputs, LinksStayAndTheirTargetsAreReplaced)
{
  const std::string rawlog = record("a.rawlog", {});
  fs::create_directory(file("elsewhere"));
  fs::create_symlink("elsewhere/t.tum", file("link.tum"));
  EXPECT_EQ(
      replay({"--input-rawlog", rawlog, "--output-tum-path", file("link.tum")}).exit_status, 0);
  EXPECT_TRUE(fs::is_symlink(file("link.tum")));
  EXPECT_GE(linesOf(file("elsewhere/t.tum")), 38U);
  EXPECT_EQ(namesIn(file("elsewhere")), "t.tum");
}

TEST_F(Outputs, FilesOfOthersStayUnlessOverwritingIsAskedFor)
{
  const std::string rawlog = record("a.rawlog", {});
  fs::create_directory(file("out"));
  const std::string thesis = write("out/states.csv", "years of work");
  expectRefusal(
      {"--input-rawlog", rawlog, "--output-dir", file("out")}, thesis, thesis, "--overwrite");
  EXPECT_EQ(namesIn(file("out")), "states.csv");
  EXPECT_EQ(replayFile(rawlog, {"--overwrite"}).exit_status, 0);
  expectAllFiles();
}

TEST_F(Outputs, AFolderHoldsOneRun)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--export", "planes,kitti,graph"}).exit_status, 0);
  const std::string notes = write("out/notes.txt", "of the user");
  EXPECT_EQ(
      namesIn(file("out")),
      "map.planes notes.txt poses.graph summary.json trajectory.kitti trajectory.kitti_times");
  auto edited = nlohmann::json::parse(contentOf(file("out/summary.json")));
  edited["outputs"].push_back({{"path", notes}, {"bytes", fs::file_size(notes)}});
  (void)write("out/summary.json", edited.dump());
  // The map is an input of the second run and stays.
  expectEnd(
      replayFile(
          rawlog,
          {"--export", "trajectory", "--map-in", file("out/map.planes"), "--no-map-update"}),
      0, "exit status 0");
  EXPECT_EQ(namesIn(file("out")), "map.planes notes.txt summary.json trajectory.tum");
  EXPECT_EQ(contentOf(notes), "of the user");
}

TEST_F(Outputs, OneRunAtATimeWritesIntoAFolder)
{
  const std::string rawlog = record("a.rawlog", {});
  const auto first = longRun("first.txt");
  first->signal(SIGSTOP);  // or it is done before the second one has begun
  expectEnd(replayFile(rawlog), 1, "another run (process ");
  first->signal(SIGTERM);
  first->signal(SIGCONT);
  expectEnd(first->wait(), 130, "interrupted");
  expectAllFiles();
}

TEST_F(Outputs, UnderNohupTheRunGoesOn)
{
  BoxRecording recording;
  recording.seconds = 30.0;
  Process process(
      {"/bin/sh", "-c", kUnderNohup, "sh", FASTLIO_REPLAY_PROGRAM, record("long.rawlog", recording),
       file("out")},
      file("log.txt"));
  for (int i = 0; i < 6000 && namesIn(file("out")).find("map.ply") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  process.signal(SIGHUP);
  expectEnd(process.wait(), 0, "exit status 0");
}

TEST_F(Outputs, AKilledRunIsNoObstacle)
{
  const std::string rawlog = record("a.rawlog", {});
  const auto killed = longRun("killed.txt");
  killed->signal(SIGKILL);
  EXPECT_EQ(killed->wait().exit_status, -1);
  EXPECT_NE(namesIn(file("out")).find(".fastlio-lock"), std::string::npos);
  EXPECT_EQ(replayFile(rawlog).exit_status, 0);
  expectAllFiles();
}

TEST_F(Outputs, AFailedRunLeavesNoFolder)
{
  const std::string junk = write("junk.rawlog", std::string(5000, 'x'));
  expectEnd(
      replay(
          {"--input-rawlog", junk, "--output-dir", file("new/out"), "--output-tum-path",
           file("other/t.tum")}),
      2, "junk.rawlog");
  const std::string rawlog = record("a.rawlog", {});
  EXPECT_EQ(
      replay({"--input-rawlog", rawlog, "--output-dir", file("new/" + std::string(300, 'x'))})
          .exit_status,
      1);
  EXPECT_FALSE(fs::exists(file("new")));
  EXPECT_FALSE(fs::exists(file("other")));
}

TEST_F(Outputs, RelativePathsAreBelowTheWorkingDirectory)
{
  const std::string rawlog = record("a.rawlog", {});
  fs::create_directory(file("fresh"));
  const auto result = Process(
                          {"/bin/sh", "-c", kInFolder, "sh", FASTLIO_REPLAY_PROGRAM, "../a.rawlog",
                           "out", file("fresh")},
                          file("log.txt"))
                          .wait();
  expectEnd(result, 0, "exit status 0");
  EXPECT_EQ(namesIn(file("fresh")), "out t.tum");
  EXPECT_EQ(contentOf(file("fresh/t.tum")), contentOf(file("fresh/out/trajectory.tum")));
  EXPECT_EQ(namesIn(file("fresh/out")).find('/'), std::string::npos);
}

TEST_F(Outputs, OfAClosedPipeEndTheRunInOrder)
{
  BoxRecording recording;
  recording.seconds = 60.0;
  const std::string rawlog = record("long.rawlog", recording);
  const auto result =
      Process(
          {"/bin/sh", "-c", kReadBriefly, "sh", FASTLIO_REPLAY_PROGRAM, rawlog, file("out")},
          file("log.txt"))
          .wait();
  EXPECT_EQ(result.exit_status, 0) << result.output;
  expectAllFiles();
  const auto summary = nlohmann::json::parse(contentOf(file("out/summary.json")));
  EXPECT_EQ(summary["status"], "interrupted");
}

TEST_F(Outputs, AFileThatGrowsTooLargeEndsTheRunInOrder)
{
  BoxRecording recording;
  recording.seconds = 20.0;
  const std::string rawlog = record("long.rawlog", recording);
  const auto result =
      Process(
          {"/bin/sh", "-c", kWithSmallFiles, "sh", FASTLIO_REPLAY_PROGRAM, rawlog, file("out")},
          file("log.txt"))
          .wait();
  expectEnd(result, 130, file("out/states.csv"));
  expectEnd(result, 130, "File too large");
  EXPECT_NE(namesIn(file("out")).find("trajectory.tum"), std::string::npos);
  EXPECT_EQ(namesIn(file("out")).find("states.csv"), std::string::npos);
  EXPECT_EQ(namesIn(file("out")).find(".tmp"), std::string::npos);
}

}  // namespace
}  // namespace fastlio::testing
