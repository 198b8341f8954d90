// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "replay_test_support.h"
#include <fastlio/exporters/standard_exporters.h>

#include <set>

namespace fastlio::testing
{
namespace
{
using Export = ReplayTest;

std::set<std::string> filesIn(const std::string& folder)
{
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

TEST_F(Export, EveryNameGivesItsFileAndTheReportTellsIt)
{
  std::string names;
  for (const auto& kind : exporterKinds())
    names += (names.empty() ? "" : ",") + std::string(kind.name);
  const auto result = replayFile(record("a.rawlog", {}), {"--export", names});
  expectEnd(result, 0, "exit status 0");
  for (const auto& kind : exporterKinds())
  {
    const std::string path = file("out/" + std::string(kind.file));
    EXPECT_TRUE(std::filesystem::exists(path)) << path;
    EXPECT_NE(result.output.find(path), std::string::npos) << path << "\n" << result.output;
  }
  for (const auto& name : filesIn(file("out")))
    EXPECT_EQ(name.find(".tmp"), std::string::npos) << name;
}

TEST_F(Export, OnlyWhatIsNamedIsWritten)
{
  expectEnd(replayFile(record("a.rawlog", {}), {"--export", "kitti,imu_rate"}), 0, "exit status 0");
  EXPECT_EQ(
      filesIn(file("out")),
      (std::set<std::string>{
          "trajectory.kitti", "trajectory.kitti_times", "imu_rate.csv", "summary.json"}));
  EXPECT_GT(linesOf(file("out/imu_rate.csv")), 100U);
}

TEST_F(Export, TheParameterFileNamesThemToo)
{
  const auto config = write("c.yaml", "output: {exporters: 'pcd'}\n");
  expectEnd(replayFile(record("a.rawlog", {}), {"-c", config}), 0, "map.pcd");
  EXPECT_EQ(filesIn(file("out")), (std::set<std::string>{"map.pcd", "summary.json"}));
}

TEST_F(Export, AWrongNameIsAWrongCommandLine)
{
  expectEnd(replayFile(record("a.rawlog", {}), {"--export", "pdc"}), 1, "no exporter 'pdc'");
  expectEnd(
      replay(
          {"--input-rawlog", record("a.rawlog", {}), "--output-tum-path", file("t.tum"), "--export",
           "pcd"}),
      1, "--output-dir");
}

/** Points of a text map in an order of their own. */
std::multiset<std::string> linesIn(const std::string& text)
{
  std::istringstream in(text);
  std::multiset<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.insert(line);
  return lines;
}

TEST_F(Export, AMapThatDoesNotFitIntoMemoryIsTheSame)
{
  const std::string rawlog = record("a.rawlog", {});
  const std::string tiles = "output: {exporters: text, tile_size: 1.0, map_memory: ";
  ASSERT_EQ(replayFile(rawlog, {"-c", write("a.yaml", tiles + "5}\n")}).exit_status, 0);
  const auto in_memory = linesIn(contentOf(file("out/map.txt")));
  ASSERT_EQ(replayFile(rawlog, {"-c", write("b.yaml", tiles + "0.01}\n")}).exit_status, 0);
  EXPECT_GT(in_memory.size(), 1000U);
  EXPECT_EQ(linesIn(contentOf(file("out/map.txt"))), in_memory);
}

}  // namespace
}  // namespace fastlio::testing
