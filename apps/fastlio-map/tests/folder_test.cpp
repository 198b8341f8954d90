// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The folder that the program writes into: of another run, of a killed one, of somebody else.

#include "folder_listing.h"
#include "map_fixture.h"
#include <fastlio/files/folder_lock.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace fastlio::testing
{
namespace
{
/** Waits until a folder has so many files, of which the lock is the first. False: it never has. */
bool comeUpTo(std::size_t files, const std::string& folder)
{
  const auto count = [&]
  {
    std::error_code error;
    const fs::directory_iterator all(folder, error);
    return error ? 0U : static_cast<std::size_t>(std::distance(begin(all), end(all)));
  };
  for (int tries = 0; tries < 60000; ++tries)
  {
    if (count() >= files) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/** Whatever was killed leaves no summary; started again, the program has the same bytes. */
TEST_F(Map, KilledAndStartedAgainHasTheSameBytes)
{
  const std::string rawlog = record("walk", walk(16.0));
  const auto arguments = [&](const std::string& name)
  {
    return std::vector<std::string>{
        FASTLIO_MAP_PROGRAM, rawlog,     "-o",
        folder_.file(name),  "--export", "trajectory,covariance,planes,summary"};
  };
  ASSERT_EQ(Process(arguments("whole"), folder_.file("log.txt")).wait().exit_status, 0);
  // At the start of its work, then while it writes.
  for (const std::size_t files : {1U, 2U})
  {
    Process process(arguments("killed"), folder_.file("log.txt"));
    ASSERT_TRUE(comeUpTo(files, folder_.file("killed")));
    process.signal(SIGKILL);
    ASSERT_EQ(process.wait().exit_status, -1) << "it was faster than to be killed";
    EXPECT_FALSE(fs::exists(folder_.file("killed") + "/summary.json"));
  }
  ASSERT_EQ(Process(arguments("killed"), folder_.file("log.txt")).wait().exit_status, 0);
  for (const char* file : {"/trajectory.tum", "/covariance.csv", "/map.planes"})
    EXPECT_TRUE(contentOf(folder_.file("killed") + file) == contentOf(folder_.file("whole") + file))
        << file;
}

/** Another run's folder is refused before the work, not after it. */
TEST_F(Map, AFolderInUseIsRefusedAtOnce)
{
  const std::string rawlog = record("walk", walk(16.0));
  fs::create_directory(folder_.file("map"));
  const auto running = std::make_unique<FolderLock>(folder_.file("map"));
  const ProcessResult refused = run({rawlog, "-o", folder_.file("map"), "--export", "trajectory"});
  EXPECT_EQ(refused.exit_status, 1);
  EXPECT_NE(refused.output.find(std::to_string(getpid())), std::string::npos) << refused.output;
  EXPECT_FALSE(fs::exists(folder_.file("map") + "/summary.json"));
}

TEST_F(Map, DoesNotReplaceWhatItHasNotWritten)
{
  const std::string rawlog = record("walk", walk(8.0));
  fs::create_directory(folder_.file("mine"));
  std::ofstream(folder_.file("mine") + "/map.ply") << "mine";
  EXPECT_EQ(run({rawlog, "-o", folder_.file("mine"), "--export", "ply"}).exit_status, 1);
  EXPECT_EQ(contentOf(folder_.file("mine") + "/map.ply"), "mine");
}

/** Of an earlier run with other sessions; anybody may have edited the record. */
TEST_F(Map, OnlyFilesOfTheProgramGoWithAnEarlierRun)
{
  const std::string rawlog = record("walk", walk(8.0));
  fs::create_directory(folder_.file("map"));
  std::string outputs;
  for (const char* name :
       {"map.las", "trajectory.tuesday.tum", "trajectory..tum", "map.tuesday.las", "thesis.tum"})
  {
    std::ofstream(folder_.file("map") + "/" + name) << "1234";
    outputs +=
        std::string(outputs.empty() ? "" : ",") + R"({"path": ")" + name + R"(", "bytes": 4})";
  }
  std::ofstream(folder_.file("map") + "/summary.json")
      << R"({"program": "fastlio-map", "exit_status": 0, "outputs": [)" << outputs << "]}";
  ASSERT_EQ(run({rawlog, "-o", folder_.file("map"), "--export", "trajectory"}).exit_status, 0);
  EXPECT_EQ(
      namesIn(folder_.file("map")),
      "map.tuesday.las summary.json thesis.tum trajectory..tum trajectory.tum");
}

/** Either would remove what the other one has written. */
TEST_F(Map, AFolderOfAnotherProgramIsRefused)
{
  const std::string rawlog = record("walk", walk(8.0));
  const auto replay = [&](const std::string& name)
  {
    return Process(
               {FASTLIO_REPLAY_PROGRAM, rawlog, "-o", folder_.file(name)}, folder_.file("r.txt"))
        .wait();
  };
  ASSERT_EQ(replay("run").exit_status, 0);
  ASSERT_EQ(run({rawlog, "-o", folder_.file("map"), "--export", "planes"}).exit_status, 0);
  const ProcessResult map = run({rawlog, "-o", folder_.file("run"), "--export", "planes"});
  EXPECT_EQ(map.exit_status, 1);
  EXPECT_NE(map.output.find("holds a run of fastlio-replay"), std::string::npos) << map.output;
  EXPECT_TRUE(fs::exists(folder_.file("run") + "/timing.csv"));
  const ProcessResult again = replay("map");
  EXPECT_EQ(again.exit_status, 1);
  EXPECT_NE(again.output.find("holds a run of fastlio-map"), std::string::npos) << again.output;
  EXPECT_TRUE(fs::exists(folder_.file("map") + "/map.planes"));
  EXPECT_EQ(
      run({rawlog, "-o", folder_.file("run"), "--export", "planes", "--overwrite"}).exit_status, 0);
  // Its folder holds no recording.
  const ProcessResult mapped = run({folder_.file("map"), "-o", folder_.file("next")});
  EXPECT_EQ(mapped.exit_status, 2);
  EXPECT_NE(mapped.output.find("is a folder of fastlio-map"), std::string::npos) << mapped.output;
  std::ofstream(folder_.file("map") + "/summary.json") << R"({"input": 3})";
  const ProcessResult damaged = run({folder_.file("map"), "-o", folder_.file("next")});
  EXPECT_EQ(damaged.exit_status, 2);
  EXPECT_EQ(damaged.output.find("json.exception"), std::string::npos) << damaged.output;
}

}  // namespace
}  // namespace fastlio::testing
