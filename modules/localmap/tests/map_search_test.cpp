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

struct Verdict
{
  bool convinces = false, fits = false;
};

/** \param mapped points where the map has a plane \param matched those that fit it */
Verdict verdictOn(std::size_t mapped, std::size_t matched, double innovation = 1.0)
{
  MatchResult match;
  match.mapped = mapped;
  match.update.last.count = matched;
  match.update.last.weighted_squares = innovation * static_cast<double>(matched);
  DeskewedScan scan;
  scan.surfaces.resize(kPoints);
  const LocalMap map = usualMap();
  return {isConvincing(match, scan, map), fitsAllThatIsMapped(match, scan, map)};
}

// A narrow view that turns round a corner. Such runs went on without the map, and were lost.
TEST(MapSearch, WhereLittleIsMappedAllOfThatFits)
{
  EXPECT_FALSE(verdictOn(170, 165).convinces);
  EXPECT_TRUE(verdictOn(170, 165).fits);
  EXPECT_FALSE(verdictOn(170, 120).fits) << "a third of what is mapped does not fit";
  EXPECT_FALSE(verdictOn(40, 40).fits) << "so few fit by chance";
  EXPECT_FALSE(verdictOn(170, 165, 20.0).fits) << "residuals of a wrong pose";
}

TEST(MapSearch, WhereMuchIsMappedAFifthOfTheUsualConvinces)
{
  EXPECT_TRUE(verdictOn(400, 210).convinces);
  EXPECT_FALSE(verdictOn(1000, 120).convinces) << "another place";
}
}  // namespace
}  // namespace fastlio
