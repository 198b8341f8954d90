// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Queries against brute force, spacing, removal, bounded memory.

#include "map_test_tools.h"
#include <fastlio/pointmap/incremental_points_map.h>

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
  CIncrementalPointsMap map;
  insertAll(map, randomCloud(1, 3000, 6.0F));
  expectExactQueries(map, 2, 8.0F);
  insertAll(map, roomCloud(3, 3000));
  expectExactQueries(map, 4, 30.0F);
}

TEST(IncrementalPointsMap, BreaksTiesByIndex)
{
  CIncrementalPointsMap map;
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
  CIncrementalPointsMap map;
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
  CIncrementalPointsMap map;
  insertAll(map, Cloud{{2, 0, 0}, {-2.0001F, 0, 0}});
  EXPECT_EQ(map.nearest(0, 0, 0, 5, 2.0).size(), 1U);
}

TEST(IncrementalPointsMap, KeepsTheMinimumSpacing)
{
  CIncrementalPointsMap map(0.4);
  const Cloud cloud = roomCloud(6, 60000);
  const std::size_t added = insertAll(map, cloud);
  EXPECT_EQ(added, map.size());
  EXPECT_LT(map.size(), cloud.size() / 2);
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
  EXPECT_EQ(insertAll(map, cloud), 0U);
}

TEST(IncrementalPointsMap, SpacingEqualToTheDistanceIsEnough)
{
  CIncrementalPointsMap map(0.5);
  EXPECT_EQ(insertAll(map, Cloud{{0, 0, 0}, {0.5F, 0, 0}, {0.25F, 0, 0}, {0, -0.5F, 0}}), 3U);
}

TEST(IncrementalPointsMap, RefusesPointsWithoutAPlace)
{
  CIncrementalPointsMap map;
  const std::size_t added =
      insertAll(map, Cloud{{0, 0, 0}, {kNan, 0, 0}, {0, kInf, 0}, {0, 0, -kInf}, {1e9F, 0, 0}});
  EXPECT_EQ(added, 1U);
  EXPECT_EQ(map.size(), 1U);
}

TEST(IncrementalPointsMap, RemovesOutsideAndStaysDenseAndExact)
{
  CIncrementalPointsMap map;
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

TEST(IncrementalPointsMap, StaysExactPointByPoint)
{
  // Sizes about those at which trees are made and joined, and removals in between.
  CIncrementalPointsMap map;
  const Cloud cloud = randomCloud(12, 700, 3.0F);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    insertAll(map, Cloud{cloud.points[i]});
    if (i % 250 == 249) map.removeOutside(0.0, 0.0, 0.0, 4.0 - 0.001 * double(i));
    const Xyz q = cloud.points[(7 * i) % cloud.size()];
    const auto found = map.nearest(q.x, q.y, q.z, 5, 2.0);
    const auto expected = bruteForce(map, q, 5, 2.0);
    ASSERT_TRUE(sameNeighbors(found, expected)) << i << '\n' << describe(found, expected);
  }
}

TEST(IncrementalPointsMap, RoundingHidesNoNeighborFarFromTheOrigin)
{
  // Single precision has 3 cm there: many equal distances, and bounds of branches that are rounded.
  CIncrementalPointsMap map;
  Cloud cloud = randomCloud(13, 3000, 4.0F);
  for (Xyz& p : cloud.points)
  {
    p.x += 4e5F;
    p.y -= 3e5F;
  }
  insertAll(map, cloud);
  for (const Xyz& q : cloud.points)
  {
    const auto found = map.nearest(q.x, q.y + 0.5F, q.z, 8);
    const auto expected = bruteForce(map, {q.x, q.y + 0.5F, q.z}, 8, 1e9);
    ASSERT_TRUE(sameNeighbors(found, expected)) << describe(found, expected);
  }
}

TEST(IncrementalPointsMap, FindsAnyNumberOfNeighbors)
{
  CIncrementalPointsMap map;
  insertAll(map, randomCloud(14, 2000, 4.0F));
  std::vector<Neighbor> found(3000);
  for (const double limit : {1.0, 3.0, 1e9})
  {
    const auto expected = bruteForce(map, {1, 0, 0}, found.size(), limit);
    const std::size_t count = map.nearest(1, 0, 0, found.size(), limit, found.data());
    ASSERT_TRUE(
        sameNeighbors(std::vector<Neighbor>(found.begin(), found.begin() + long(count)), expected));
  }
}

TEST(IncrementalPointsMap, PointsThatAreNotFiniteAreNeverFound)
{
  CIncrementalPointsMap map;
  map.insertPoint(kNan, 0, 0);
  map.insertPoint(1, 0, 0);
  map.insertPoint(0, kInf, 0);
  EXPECT_EQ(map.nearest(0, 0, 0, 5).size(), 1U);
  map.ensureIndex();
  EXPECT_EQ(map.nearest(0, 0, 0, 5).size(), 1U);
  insertAll(map, randomCloud(15, 500, 3.0F));
  expectExactQueries(map, 16, 4.0F);
  EXPECT_EQ(map.removeOutside(0, 0, 0, 9.0), 2U);
  EXPECT_EQ(map.size(), 501U);
  EXPECT_TRUE(map.indexIsCurrent());
  expectExactQueries(map, 17, 4.0F);
}

TEST(IncrementalPointsMap, QueriesRunInParallel)
{
  CIncrementalPointsMap map;
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

TEST(IncrementalPointsMap, RefusesASenselessSpacing)
{
  for (const double spacing : {-0.1, double(kNan), double(kInf)})
    EXPECT_THROW(CIncrementalPointsMap{spacing}, std::invalid_argument) << spacing;
}
