// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/match_evidence.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
ScanStatistics scanWith(std::size_t mapped, std::size_t effective, double innovation)
{
  ScanStatistics statistics;
  statistics.usual_inlier_ratio = 0.8;
  statistics.points_mapped = mapped;
  statistics.points_effective = effective;
  statistics.normalized_innovation = innovation;
  return statistics;
}

TEST(MatchEvidence, AFifthOfTheUsualRatioIsAsUsual)
{
  EXPECT_TRUE(matchesAsUsual(scanWith(1000, 161, 1.0), 1000));
  EXPECT_FALSE(matchesAsUsual(scanWith(1000, 159, 1.0), 1000));
}

TEST(MatchEvidence, AllThatIsMappedFitsHoweverLittleItIs)
{
  EXPECT_TRUE(fitsWhatIsMapped(scanWith(30, 30, 1.0)));
  EXPECT_TRUE(fitsWhatIsMapped(scanWith(60, 30, 1.0)));
  EXPECT_FALSE(fitsWhatIsMapped(scanWith(61, 30, 1.0))) << "most of the map contradicts";
}

TEST(MatchEvidence, ResidualsThatNoiseDoesNotExplainAreNoFit)
{
  EXPECT_TRUE(fitsWhatIsMapped(scanWith(30, 30, 3.0)));
  EXPECT_FALSE(fitsWhatIsMapped(scanWith(30, 30, 3.1)));
}

TEST(MatchEvidence, NothingFitsWhereNothingIsMapped)
{
  EXPECT_FALSE(fitsWhatIsMapped(scanWith(0, 0, 0.0)));
}

}  // namespace
}  // namespace fastlio
