// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/map_search.h>

#include <gtest/gtest.h>

#include <memory>

namespace fastlio
{
namespace
{
constexpr std::size_t kPoints = 1500;

/** A map that scans have matched with two of three points, and with nearly all that it knows. */
LocalMap usualMap()
{
  LocalMap map{OdometryOptions{}, std::make_shared<const Workers>(1)};
  ScanStatistics usual;
  usual.points_effective = 990;
  usual.points_mapped = 1000;
  map.learnInlierRatio(usual, kPoints);
  return map;
}

/** \param mapped points where the map has a plane \param matched those that fit it */
bool convinces(std::size_t mapped, std::size_t matched, double innovation = 1.0)
{
  MatchResult match;
  match.mapped = mapped;
  match.update.last.count = matched;
  match.update.last.weighted_squares = innovation * static_cast<double>(matched);
  DeskewedScan scan;
  scan.surfaces.resize(kPoints);
  return isConvincing(match, scan, usualMap());
}

// A narrow view that turns round a corner. Such runs went on without the map, and were lost.
TEST(MapSearch, WhereLittleIsMappedWhatFitsItConvinces)
{
  EXPECT_TRUE(convinces(170, 165));
  EXPECT_FALSE(convinces(170, 120)) << "a third of what is mapped does not fit";
  EXPECT_FALSE(convinces(40, 40)) << "so few fit by chance";
  EXPECT_FALSE(convinces(170, 165, 20.0)) << "residuals of a wrong pose";
}

TEST(MapSearch, WhereMuchIsMappedAFifthOfTheUsualConvinces)
{
  EXPECT_TRUE(convinces(400, 210));
  EXPECT_FALSE(convinces(1000, 120)) << "another place";
}
}  // namespace
}  // namespace fastlio
