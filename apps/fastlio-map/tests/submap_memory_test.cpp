// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Submaps beyond output.submap_memory: the same files, nothing left behind, and what happens when
// the disk refuses them or somebody touches them.

#include "folder_listing.h"
#include "map_fixture.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace fastlio::testing
{
namespace
{
const std::vector<std::string> kBound = {"--set", "output.submap_memory=0.001"};

class SubmapMemory : public Map
{
 protected:
  std::vector<std::string> command(const std::string& rawlog, const std::string& name) const
  {
    std::vector<std::string> words = {
        FASTLIO_MAP_PROGRAM, rawlog,     "-o",
        folder_.file(name),  "--export", "trajectory,covariance,graph,report"};
    words.insert(words.end(), kBound.begin(), kBound.end());
    return words;
  }

  /** Files of submaps that are there now. */
  std::vector<fs::path> submapFiles(const std::string& name) const
  {
    std::vector<fs::path> files;
    std::error_code error;
    fs::recursive_directory_iterator at(folder_.file(name), error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error))
      if (at->path().string().find("/map-submaps-") != std::string::npos && at.depth() > 0)
        files.push_back(at->path());
    return files;
  }

  /** Waits until there are so many. False: there never are. */
  bool haveCome(std::size_t files, const std::string& name) const
  {
    for (int tries = 0; tries < 60000; ++tries)
    {
      if (submapFiles(name).size() >= files) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  /** The summary without what another folder or another minute changes. */
  std::string factsOf(const std::string& name)
  {
    nlohmann::json summary = summaryOf(name);
    for (const char* key : {"outputs", "wall_seconds"})
      summary.erase(key);
    return summary.dump(1);
  }
};

TEST_F(SubmapMemory, ABoundChangesNoByteOfTheFiles)
{
  const std::string first = record("first", walk(45.0));
  const std::string second = record("second", anotherDay(15.0));
  const std::string kinds = "trajectory,states,covariance,ply,las,planes,graph,g2o,report,summary";
  const auto made = [&](const std::string& name, std::vector<std::string> more)
  {
    std::vector<std::string> words = {first, second, "-o", folder_.file(name), "--export", kinds};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult result = run(words);
    EXPECT_EQ(result.exit_status, 0) << result.output;
  };
  made("all", {"--threads", "1"});
  std::vector<std::string> bounded = {"--threads", "3"};
  bounded.insert(bounded.end(), kBound.begin(), kBound.end());
  made("few", bounded);
  EXPECT_EQ(factsOf("few"), factsOf("all"));
  auto few = filesIn(folder_.file("few"));
  EXPECT_EQ(few.size(), 13U);
  EXPECT_EQ(namesIn(folder_.file("few")), namesIn(folder_.file("all")));
  few.erase("summary.json");
  for (const auto& [name, content] : few)
    EXPECT_TRUE(content == contentOf(folder_.file("all/" + name))) << name;
}

TEST_F(SubmapMemory, SignalsLeaveNothingAndAKillUntilTheNextRun)
{
  const std::string rawlog = record("walk", walk(30.0));
  {
    Process stopped(command(rawlog, "map"), folder_.file("log.txt"));
    ASSERT_TRUE(haveCome(2, "map"));
    stopped.signal(SIGTERM);
    EXPECT_EQ(stopped.wait().exit_status, 130);
    EXPECT_FALSE(fs::exists(folder_.file("map")));
  }
  {
    Process killed(command(rawlog, "map"), folder_.file("log.txt"));
    ASSERT_TRUE(haveCome(2, "map"));
    killed.signal(SIGKILL);
    ASSERT_EQ(killed.wait().exit_status, -1);
    EXPECT_FALSE(submapFiles("map").empty());
  }
  const ProcessResult again = Process(command(rawlog, "map"), folder_.file("log.txt")).wait();
  ASSERT_EQ(again.exit_status, 0) << again.output;
  EXPECT_EQ(
      namesIn(folder_.file("map")),
      "covariance.csv poses.graph report.html summary.json trajectory.tum");
}

/** Whoever shortens them while the program runs gets a map without these closures, and is told. */
TEST_F(SubmapMemory, SubmapsThatSomebodyDamagesAreMissedAndTold)
{
  const std::string rawlog = record("walk", walk(55.0));
  Process process(command(rawlog, "map"), folder_.file("log.txt"));
  ASSERT_TRUE(haveCome(5, "map"));
  process.signal(SIGSTOP);
  for (const fs::path& file : submapFiles("map"))
    fs::resize_file(file, 100);
  process.signal(SIGCONT);
  const ProcessResult result = process.wait();
  EXPECT_EQ(result.exit_status, 5) << result.output;
  EXPECT_NE(result.output.find("map-submaps-"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("was it removed or changed?"), std::string::npos) << result.output;
  EXPECT_EQ(summaryOf("map")["output_problems"].size(), 1U);
  EXPECT_TRUE(fs::exists(folder_.file("map/trajectory.tum")));
  EXPECT_TRUE(submapFiles("map").empty());
}

/** A limit on the size of files stands for a full disk: submaps are larger than all outputs. */
TEST_F(SubmapMemory, WhatTheDiskRefusesStaysInMemory)
{
  const std::string rawlog = record("walk", walk(55.0));
  const auto limited = [&](const std::string& name, const std::string& limit)
  {
    std::vector<std::string> words = command(rawlog, name);
    *std::find(words.begin(), words.end(), "trajectory,covariance,graph,report") = "graph";
    words.insert(words.begin(), {"/bin/sh", "-c", limit + " exec \"$@\"", "sh"});
    return Process(words, folder_.file("log.txt")).wait();
  };
  ASSERT_EQ(limited("free", "").exit_status, 0);
  const ProcessResult full = limited("full", "trap '' XFSZ; ulimit -f 64;");
  EXPECT_EQ(full.exit_status, 0) << full.output;
  EXPECT_NE(full.output.find("File too large"), std::string::npos) << full.output;
  EXPECT_NE(full.output.find("output.submap_memory"), std::string::npos) << full.output;
  EXPECT_EQ(
      contentOf(folder_.file("full/poses.graph")), contentOf(folder_.file("free/poses.graph")));
  EXPECT_EQ(namesIn(folder_.file("full")), "poses.graph summary.json");
}

/** Pieces of the points' map that cannot be written: no file holds a map with gaps. */
TEST_F(Map, PiecesThatTheDiskRefusesCostEveryFileOfTheMap)
{
  const std::string rawlog = record("walk", walk(30.0));
  const std::vector<std::string> words = {
      "/bin/sh",
      "-c",
      "trap '' XFSZ; ulimit -f 8; exec \"$@\"",
      "sh",
      FASTLIO_MAP_PROGRAM,
      rawlog,
      "-q",
      "-o",
      folder_.file("full"),
      "--export",
      "las",
      "--set",
      "output.map_memory=0.01"};
  const ProcessResult full = Process(words, folder_.file("log.txt")).wait();
  EXPECT_EQ(full.exit_status, 5) << full.output;
  const std::string reason = "map.las': cannot write '" + folder_.file("full") + "/map-tiles-";
  EXPECT_NE(full.output.find(reason), std::string::npos) << full.output;
  EXPECT_FALSE(fs::exists(folder_.file("full/map.las")));
}

}  // namespace
}  // namespace fastlio::testing
