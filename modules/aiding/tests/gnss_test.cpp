// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gnss_test.cpp GNSS over kilometres, at the level of the pose graph: motions with the noise
 * that their covariances have, and fixes with noise. FASTLIO_EVERYTHING=1: up to 100 km, with the
 * time that this takes. */

#include "gnss_road.h"
#include "repeats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace fastlio
{
using testing::EarthErrors;
using testing::errorsOf;
using testing::kNoise;
using testing::Road;

TEST(Gnss, FiveKilometresWithAMetreOfNoise)
{
  for (unsigned seed = 1; seed <= 2; ++seed)
  {
    Road road(5000.0, seed);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    const EarthErrors errors = errorsOf(road, map, gnss);
    std::printf(
        "5 km, %zu fixes: %.2f m horizontally; a fix %.2f m, correlation %.2f\n", gnss.fixes,
        errors.horizontal, gnss.horizontal_std, gnss.correlation);
    EXPECT_LT(errors.horizontal, 0.3);
    EXPECT_NEAR(gnss.horizontal_std, kNoise, 0.15 * kNoise);
    EXPECT_LT(gnss.rejected, 5U);
  }
}

/** By the account of the receiver these are possible. By the noise that it has they are not. */
TEST(Gnss, LeavesReflectionsOutThatTheReceiversAccountAllows)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    Road road(1200.0, seed, 2.0 * kNoise);
    const std::size_t wrong = road.reflect({7.0, -5.0, 3.0});
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    EXPECT_GE(gnss.rejected, wrong);
    EXPECT_LE(gnss.rejected, wrong + 2);
    EXPECT_NEAR(gnss.horizontal_std, kNoise, 0.2 * kNoise);
  }
}

/** A receiver that promises centimetres and is off by a metre: the few fixes that agree are chance,
 * and their residuals would seem to be millimetres. */
TEST(Gnss, IsNotUsedWhereFewFixesAgree)
{
  Road road(1200.0, 1, 0.03);
  const auto [map, gnss] = road.mapped();
  EXPECT_FALSE(gnss.used);
  EXPECT_EQ(gnss.fixes, map.submaps.size());
  EXPECT_GT(2 * gnss.rejected, gnss.fixes);
  EXPECT_NE(gnss.reason.find("positions agree with each other"), std::string::npos) << gnss.reason;
  EXPECT_EQ(gnss.horizontal_std, 0.0);
  EXPECT_FALSE(map.corrected);
  EXPECT_FALSE(map.estimate.T_earth_world);
  EXPECT_TRUE(map.graph.positions.empty());
  for (std::size_t i = 0; i < map.submaps.size(); ++i)
    EXPECT_EQ(map.estimate.nodes[i].p, map.submaps[i].reference.T_world_body.p);
}

/** Which half is right nobody knows. */
TEST(Gnss, IsNotUsedWhereHalfOfTheFixesContradictTheOthers)
{
  Road road(1200.0, 1);
  road.jump({30.0, -20.0, 0.0});
  const auto [map, gnss] = road.mapped();
  EXPECT_FALSE(gnss.used);
  EXPECT_NE(gnss.reason.find("positions agree with each other"), std::string::npos) << gnss.reason;
}

/** Nobody gave control points, or could give them larger standard deviations. */
TEST(Gnss, RefusedPositionsAreCalledPositions)
{
  Road road(1200.0, 1);
  road.freeze();
  const auto [map, gnss] = road.mapped();
  EXPECT_FALSE(gnss.used);
  EXPECT_EQ(gnss.reason.find("positions contradict each other: "), 0U) << gnss.reason;
  EXPECT_NE(gnss.reason.find("check the antenna's place"), std::string::npos) << gnss.reason;
}

/** The place of the map on the earth is known as well as its covariance says. */
TEST(Gnss, CovarianceOfThePlaceIsThatOfItsErrors)
{
  constexpr unsigned kRoads = 20;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kRoads; ++seed)
  {
    Road road(600.0, seed);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    sum += errorsOf(road, map, gnss).nees;
  }
  std::printf("NEES of heading and place: %.1f, 3 degrees of freedom\n", sum / kRoads);
  EXPECT_GT(sum / kRoads, 1.5);
  EXPECT_LT(sum / kRoads, 5.0);
}

/** The cost grows with the length of the way, not with its square. */
TEST(Gnss, CostOverTheLength)
{
  std::vector<double> lengths{1250.0, 5000.0};
  if (testing::everything()) lengths = {5000.0, 20000.0, 100000.0};
  std::vector<double> seconds;
  for (const double length : lengths)
  {
    const std::clock_t begin = std::clock();
    Road road(length, 1);
    const auto [map, gnss] = road.mapped();
    ASSERT_TRUE(gnss.used) << gnss.reason;
    seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    std::printf(
        "%.1f km: %zu submaps, %.2f s of the processor, %.2f m horizontally\n", 1e-3 * length,
        map.submaps.size(), seconds.back(), errorsOf(road, map, gnss).horizontal);
  }
  // Proportional, with room for the noise of a busy machine.
  const double ratio = seconds.back() / std::max(seconds.front(), 1e-3);
  if (!testing::everything()) return;
  EXPECT_LT(ratio, 2.0 * lengths.back() / lengths.front());
}

}  // namespace fastlio
