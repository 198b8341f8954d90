// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Queries against brute force, spacing, removal, bounded memory.

#include "map_test_tools.h"
#include <fastlio/map/incremental_points_map.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <thread>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

}  // namespace

TEST(IncrementalPointsMap, NearestEqualsBruteForceInClutterAndOnSurfaces)
{
  for (const double cell : {0.2, 1.0, 5.0})
  {
    CIncrementalPointsMap map(options(cell, 0.0));
    insertAll(map, randomCloud(1, 3000, 6.0F));
    expectExactQueries(map, 2, 8.0F);
    insertAll(map, roomCloud(3, 3000));
    expectExactQueries(map, 4, 30.0F);
  }
}

TEST(IncrementalPointsMap, BreaksTiesByIndex)
{
  CIncrementalPointsMap map(options(0.75, 0.0));
  Cloud lattice;
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int z = -4; z <= 4; ++z)
        lattice.add({0.5F * float(x), 0.5F * float(y), 0.5F * float(z)});
  insertAll(map, shuffled(lattice, 5));
  for (const Xyz q : {Xyz{0, 0, 0}, Xyz{0.25F, 0.25F, 0.25F}, Xyz{-0.5F, 0.25F, 1}, Xyz{9, 0, 0}})
  {
    for (std::size_t k = 1; k <= kMaxNeighbors; ++k)
    {
      const auto found = map.nearest(q.x, q.y, q.z, k);
      const auto expected = bruteForce(map, q, k, 1e9);
      ASSERT_TRUE(sameNeighbors(found, expected)) << describe(found, expected);
    }
  }
}

TEST(IncrementalPointsMap, CopesWithFewPointsAndFarQueries)
{
  CIncrementalPointsMap map(options(0.5, 0.0));
  EXPECT_TRUE(map.nearest(1, 2, 3, 5).empty());
  insertAll(map, Cloud{{1, -2, 5000}, {0, 0, -5000}, {0, 0, 0}});
  EXPECT_EQ(map.nearest(0, 0, 0, 5).size(), 3U);
  EXPECT_EQ(map.nearest(0, 0, 0, 5, 1.0).size(), 1U);
  EXPECT_EQ(map.nearest(0, 2, 0, 5, 1.0).size(), 0U);
  EXPECT_EQ(map.nearest(0, 0, 0, 0).size(), 0U);
  for (const Xyz q : {Xyz{1e6F, 0, 0}, Xyz{-3e5F, 7e5F, -2e6F}, Xyz{0, 0, 3e7F}})
  {
    const auto found = map.nearest(q.x, q.y, q.z, 2);
    ASSERT_TRUE(sameNeighbors(found, bruteForce(map, q, 2, 1e30)));
  }
  EXPECT_TRUE(map.nearest(kNan, 0, 0, 2).empty());
  EXPECT_TRUE(map.nearest(0, kInf, 0, 2).empty());
  EXPECT_TRUE(map.nearest(0, 0, 0, 2, -1.0).empty());
  EXPECT_TRUE(map.nearest(0, 0, 0, 2, kNan).empty());
  EXPECT_THROW((void)map.nearest(0, 0, 0, kMaxNeighbors + 1), std::invalid_argument);
}

TEST(IncrementalPointsMap, LimitIncludesItsOwnDistance)
{
  CIncrementalPointsMap map(options(1.0, 0.0));
  insertAll(map, Cloud{{2, 0, 0}, {-2.0001F, 0, 0}});
  EXPECT_EQ(map.nearest(0, 0, 0, 5, 2.0).size(), 1U);
}

TEST(IncrementalPointsMap, KeepsTheMinimumSpacing)
{
  CIncrementalPointsMap map(options(0.9, 0.4));
  const Cloud cloud = roomCloud(6, 60000);
  const auto report = insertAll(map, cloud);
  EXPECT_EQ(report.added, map.size());
  EXPECT_EQ(report.added + report.too_near, cloud.size());
  EXPECT_GT(report.too_near, cloud.size() / 2);
  // Points in the map are apart, and every point left out has one in the map nearby.
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const Xyz p = pointOf(map, i);
    const auto two = map.nearest(p.x, p.y, p.z, 2);
    ASSERT_GE(two[1].distance_sqr, 0.4F * 0.4F * (1 - 1e-6F));
  }
  for (const Xyz& p : cloud.points)
  {
    ASSERT_LT(map.nearest(p.x, p.y, p.z, 1)[0].distance_sqr, 0.4F * 0.4F);
  }
  EXPECT_EQ(insertAll(map, cloud).added, 0U);
  EXPECT_EQ(map.insertionTotals().added, map.size());
}

TEST(IncrementalPointsMap, SpacingEqualToTheDistanceIsEnough)
{
  CIncrementalPointsMap map(options(1.0, 0.5));
  const auto report = insertAll(map, Cloud{{0, 0, 0}, {0.5F, 0, 0}, {0.25F, 0, 0}, {0, -0.5F, 0}});
  EXPECT_EQ(report.added, 3U);
  EXPECT_EQ(report.too_near, 1U);
}

TEST(IncrementalPointsMap, SpacingMayExceedTheCells)
{
  CIncrementalPointsMap map(options(0.1, 1.5));
  insertAll(map, randomCloud(7, 4000, 4.0F));
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const Xyz p = pointOf(map, i);
    ASSERT_GE(bruteForce(map, p, 2, 1e9)[1].distance_sqr, 2.2499F);
  }
}

TEST(IncrementalPointsMap, RefusesPointsWithoutAPlace)
{
  CIncrementalPointsMap map(options(0.5, 0.0));
  const auto report =
      insertAll(map, Cloud{{0, 0, 0}, {kNan, 0, 0}, {0, kInf, 0}, {0, 0, -kInf}, {1e9F, 0, 0}});
  EXPECT_EQ(report.added, 1U);
  EXPECT_EQ(report.refused, 4U);
  EXPECT_EQ(map.insertionTotals().refused, 4U);
}

TEST(IncrementalPointsMap, RemovesOutsideAndStaysDenseAndExact)
{
  CIncrementalPointsMap map(options(1.0, 0.0));
  const Cloud cloud = randomCloud(8, 20000, 10.0F);
  insertAll(map, cloud);
  std::size_t expected = 0;
  for (const Xyz& p : cloud.points)
    expected += distance(p, {2, -3, 1}) <= 6.0 ? 1U : 0U;
  EXPECT_EQ(map.removeOutside(2, -3, 1, 6.0), cloud.size() - expected);
  EXPECT_EQ(map.size(), expected);
  EXPECT_TRUE(map.indexIsCurrent());
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    ASSERT_LE(distance(pointOf(map, i), {2, -3, 1}), 6.0);
  }
  expectExactQueries(map, 9, 8.0F);
  insertAll(map, randomCloud(10, 2000, 10.0F));
  expectExactQueries(map, 11, 12.0F);
  EXPECT_EQ(map.removeOutside(1000, 0, 0, 1.0), map.size() + expected + 2000 - map.size());
  EXPECT_TRUE(map.empty());
  EXPECT_THROW(map.removeOutside(0, 0, 0, -1), std::invalid_argument);
  EXPECT_THROW(map.removeOutside(0, 0, 0, kNan), std::invalid_argument);
}

TEST(IncrementalPointsMap, MemoryStaysBoundedWhileTheRegionMoves)
{
  CIncrementalPointsMap map(options(1.0, 0.3));
  std::size_t largest_early = 0, largest_late = 0;
  for (int step = 0; step < 120; ++step)
  {
    const float x = 5.0F * static_cast<float>(step);
    Cloud cloud = randomCloud(static_cast<unsigned>(step), 3000, 15.0F);
    for (Xyz& p : cloud.points)
      p.x += x;
    insertAll(map, cloud);
    map.removeOutside(x, 0, 0, 15.0);
    std::size_t& largest = step < 40 ? largest_early : largest_late;
    largest = std::max(largest, map.memoryBytes());
  }
  EXPECT_LE(largest_late, largest_early + largest_early / 5);
}

TEST(IncrementalPointsMap, PointsThatAreNotFiniteAreNeverFound)
{
  CIncrementalPointsMap map(options(0.8, 0.0));
  map.insertPoint(kNan, 0, 0);
  map.insertPoint(1, 0, 0);
  map.insertPoint(0, kInf, 0);
  EXPECT_EQ(map.nearest(0, 0, 0, 5).size(), 1U);
  map.ensureIndex();
  EXPECT_EQ(map.nearest(0, 0, 0, 5).size(), 1U);
  EXPECT_EQ(map.removeOutside(0, 0, 0, 5.0), 2U);
  EXPECT_EQ(map.size(), 1U);
}

TEST(IncrementalPointsMap, QueriesRunInParallel)
{
  CIncrementalPointsMap map(options(0.8, 0.0));
  insertAll(map, roomCloud(19, 20000));
  std::vector<std::size_t> mismatches(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < mismatches.size(); ++t)
  {
    threads.emplace_back(
        [&, t]
        {
          for (const Xyz& q : randomCloud(20 + static_cast<unsigned>(t), 20, 12.0F).points)
          {
            const auto found = map.nearest(q.x, q.y, q.z, 5);
            if (!sameNeighbors(found, bruteForce(map, q, 5, 1e9))) ++mismatches[t];
          }
        });
  }
  for (std::thread& thread : threads)
    thread.join();
  for (const std::size_t n : mismatches)
    EXPECT_EQ(n, 0U);
}

TEST(IncrementalPointsMap, RefusesSenselessOptions)
{
  EXPECT_THROW(CIncrementalPointsMap(options(0.0, 0.0)), std::invalid_argument);
  EXPECT_THROW(CIncrementalPointsMap(options(-1.0, 0.0)), std::invalid_argument);
  EXPECT_THROW(CIncrementalPointsMap(options(kNan, 0.0)), std::invalid_argument);
  EXPECT_THROW(CIncrementalPointsMap(options(kInf, 0.0)), std::invalid_argument);
  EXPECT_THROW(CIncrementalPointsMap(options(1.0, -0.1)), std::invalid_argument);
  EXPECT_THROW(CIncrementalPointsMap(options(1.0, kNan)), std::invalid_argument);
  CIncrementalPointsMap map;
  insertAll(map, randomCloud(24, 100, 1.0F));
  EXPECT_THROW(map.setCreationOptions(options(0.0, 0.0)), std::invalid_argument);
  EXPECT_EQ(map.creationOptions().cell_size, 1.0);
  map.setCreationOptions(options(0.3, 0.0));
  expectExactQueries(map, 25, 2.0F);
}
