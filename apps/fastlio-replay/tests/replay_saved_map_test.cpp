// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "replay_test_support.h"

#include <mrpt/core/format.h>

#include <sstream>

namespace fastlio::testing
{
namespace
{
using SavedMaps = ReplayTest;

std::array<double, 3> firstPosition(const std::string& tum)
{
  std::istringstream in(tum);
  double t = 0;
  std::array<double, 3> p{};
  in >> t >> p[0] >> p[1] >> p[2];
  return p;
}

/** Every format of a map leads back to where it began. */
TEST_F(SavedMaps, StartWhereTheEarlierRunDid)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--export", "ply,pcd,metricmap,planes,trajectory"}).exit_status, 0);
  const auto expected = firstPosition(contentOf(file("out/trajectory.tum")));
  for (const auto* map : {"map.ply", "map.pcd", "map.metricmap", "map.planes"})
  {
    const auto result = replay(
        {"--input-rawlog", rawlog, "--output-dir", file("again"), "--export", "trajectory,ply",
         "--map-in", file(std::string("out/") + map), "--initial-pose", "0.2,-0.1,-0.1,3,0,0",
         "--no-map-update"});
    expectEnd(result, 0, "exit status 0");
    EXPECT_EQ(result.output.find("first scan"), std::string::npos) << result.output;
    const auto seen = firstPosition(contentOf(file("again/trajectory.tum")));
    // Sixteen lines in a box hardly determine floor and ceiling, points alone of them do not.
    const std::size_t axes = std::string_view(map) == "map.planes" ? 3 : 2;
    for (std::size_t i = 0; i < axes; ++i)
      EXPECT_NEAR(seen.at(i), expected.at(i), i < 2 ? 0.05 : 0.1) << map;
  }
}

TEST_F(SavedMaps, AMapThatGrowsIsSavedAsAWhole)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--export", "text,ply"}).exit_status, 0);
  const std::size_t points = linesOf(file("out/map.txt"));
  const auto result = replay(
      {"--input-rawlog", rawlog, "--output-dir", file("again"), "--export", "text", "--map-in",
       file("out/map.ply")});
  expectEnd(result, 0, "exit status 0");
  EXPECT_GE(linesOf(file("again/map.txt")), points - 1);
}

TEST_F(SavedMaps, CoordinatesOfTheEarthAreKept)
{
  const std::string rawlog = record("a.rawlog", {});
  ASSERT_EQ(replayFile(rawlog, {"--export", "text,trajectory"}).exit_status, 0);
  const auto near = firstPosition(contentOf(file("out/trajectory.tum")));
  // The map that was written, at UTM coordinates.
  std::istringstream lines(contentOf(file("out/map.txt")));
  std::string rows, line;
  std::size_t points = 0;
  std::getline(lines, line);
  for (double x = 0, y = 0, z = 0; lines >> x >> y >> z && std::getline(lines, line); ++points)
    rows += mrpt::format("%.4f %.4f %.4f\n", x + 448'000.0, y + 5'412'000.0, z);
  const std::string map = write(
      "utm.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nPOINTS " +
                     std::to_string(points) + "\nDATA ascii\n" + rows);
  const auto result = replay(
      {"--input-rawlog", rawlog, "--output-dir", file("again"), "--export",
       "trajectory,ply,summary", "--map-in", map, "--initial-pose",
       "448000.2,5411999.9,-0.1,3,0,0"});
  expectEnd(result, 0, "count from (448000, 5412000, 0) m");
  const auto seen = firstPosition(contentOf(file("again/trajectory.tum")));
  EXPECT_NEAR(seen[0], near[0] + 448'000.0, 0.05);
  EXPECT_NEAR(seen[1], near[1] + 5'412'000.0, 0.05);
  EXPECT_NE(contentOf(file("again/map.ply")).find("property double x\n"), std::string::npos);
  EXPECT_NE(contentOf(file("again/summary.json")).find("map_origin_m"), std::string::npos);
}

TEST_F(SavedMaps, WhatIsWrongIsSaid)
{
  const std::string rawlog = record("a.rawlog", {});
  expectEnd(replayFile(rawlog, {"--map-in", file("none.ply")}), 2, "none.ply");
  expectEnd(replayFile(rawlog, {"--map-in", write("x", "junk")}), 2, "neither PLY nor PCD");
  expectEnd(replayFile(rawlog, {"--no-map-update"}), 1, "--map-in");
  expectEnd(replayFile(rawlog, {"--initial-pose", "1,2,3,4,5,6"}), 1, "--map-in");
}

}  // namespace
}  // namespace fastlio::testing
