// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Inputs that are damaged, or no files: a clear sentence and the right exit status, at once.

#include "replay_test_support.h"

#include <chrono>
#include <sys/stat.h>

namespace fastlio::testing
{
namespace
{
using HostileInput = ReplayTest;

std::size_t linesIn(const ProcessResult& result)
{
  return static_cast<std::size_t>(std::count(result.output.begin(), result.output.end(), '\n'));
}

TEST_F(HostileInput, ATailOfZerosEndsAsTruncatedAndTheNextPartIsRead)
{
  BoxRecording recording;
  const std::string first = file("plain.rawlog");
  const std::string inflate = "gzip -dc " + record("a.rawlog", recording) + " > " + first;
  ASSERT_EQ(Process({"/bin/sh", "-c", inflate}, file("log.txt")).wait().exit_status, 0);
  std::filesystem::resize_file(first, std::filesystem::file_size(first) + 1'200'000'000);
  recording.start = recording.seconds;
  const auto result = replay(
      {"--input-rawlog", first, "--input-rawlog", record("b.rawlog", recording), "--output-dir",
       file("out")});
  expectEnd(result, 3, "zeros, as after a loss of power");
  EXPECT_GE(linesOf(file("out/trajectory.tum")), 60U);
}

TEST_F(HostileInput, ARecordingFromAPipeIsRefusedAtOnce)
{
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  const auto begin = std::chrono::steady_clock::now();
  for (const std::string& name : {file("pipe"), std::string("/dev/zero"), std::string("-")})
    expectEnd(replayFile(name), 2, "save it to a file first");
  const std::string piped = "cat " + record("a.rawlog", {}) + " | " + FASTLIO_REPLAY_PROGRAM +
                            " --input-rawlog /dev/stdin --output-dir " + file("out");
  expectEnd(
      Process({"/bin/sh", "-c", piped}, file("log.txt")).wait(), 2, "save it to a file first");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST_F(HostileInput, TheSameFileTwiceIsRefused)
{
  const std::string rawlog = record("a.rawlog", {});
  std::filesystem::create_symlink(rawlog, file("b.rawlog"));
  const auto result = replay(
      {"--input-rawlog", rawlog, "--input-rawlog", file("b.rawlog"), "--output-dir", file("out")});
  expectEnd(result, 1, "is given twice");
  expectEnd(replay({rawlog, file("b.rawlog"), "--output-dir", file("out")}), 1, "is given twice");
}

TEST_F(HostileInput, ARecordingAsConfigurationIsOneLine)
{
  const std::string rawlog = record("a.rawlog", {});
  const auto result = replayFile(rawlog, {"-c", rawlog});
  expectEnd(result, 1, "a recording is given to --input-rawlog");
  EXPECT_EQ(linesIn(result), 1U) << result.output;
}

TEST_F(HostileInput, AnInitialPoseThatIsNoneIsRefused)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--export", "ply"}).exit_status, 0);
  for (const char* pose : {"nan,0,0,0,0,0", "0,0,0,inf,0,0", "1e300,0,0,0,0,0"})
  {
    const auto result = replay(
        {"--input-rawlog", rawlog, "--output-dir", file("again"), "--map-in", file("out/map.ply"),
         "--initial-pose", pose});
    expectEnd(result, 1, "--initial-pose");
  }
}

TEST_F(HostileInput, ADamagedMapIsOneSentence)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--export", "ply,pcd,metricmap,planes"}).exit_status, 0);
  for (const auto* name : {"map.ply", "map.pcd", "map.metricmap", "map.planes"})
  {
    const std::string whole = contentOf(file(std::string("out/") + name));
    const std::string cut = write(std::string("cut_") + name, whole.substr(0, whole.size() / 2));
    const auto result = replay(
        {"--input-rawlog", rawlog, "--output-dir", file("again"), "--map-in", cut, "-v", "ERROR"});
    expectEnd(result, 2, cut);
    EXPECT_EQ(linesIn(result), 1U) << name << result.output;
  }
}

}  // namespace
}  // namespace fastlio::testing
