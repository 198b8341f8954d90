// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The cells below the index: numbering, bounds, and bookkeeping under random growth and shrinkage.

#include "point_index.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

using namespace fastlio;

namespace
{
Point3 randomPoint(std::mt19937& rng, float extent)
{
  std::uniform_real_distribution<float> u(-extent, extent);
  return {u(rng), u(rng), u(rng)};
}

std::set<std::uint32_t> pointsWithin(const PointIndex& index, const Point3& q, float radius_sqr)
{
  RadiusCollector collector(radius_sqr);
  index.search(q, collector);
  std::set<std::uint32_t> found;
  for (const Neighbor& n : std::move(collector).sorted())
    found.insert(n.point_index);
  return found;
}
}  // namespace

TEST(CellGrid, NumbersCellsByFloorOnBothSidesOfTheOrigin)
{
  const CellGrid grid(0.5);
  EXPECT_EQ(grid.cellOf(0.0), 0);
  EXPECT_EQ(grid.cellOf(0.49), 0);
  EXPECT_EQ(grid.cellOf(0.5), 1);
  EXPECT_EQ(grid.cellOf(-0.01), -1);
  EXPECT_EQ(grid.cellOf(-0.5), -1);
  EXPECT_EQ(grid.cellOf(-0.51), -2);
}

TEST(CellGrid, CellAndBlockNumbersAreInverse)
{
  for (std::int32_t v = -9; v <= 9; ++v)
  {
    const GridCoord cell{v, -v, 3 * v};
    const GridCoord back = cellOfBlock(blockOf(cell), cellInBlock(cell));
    EXPECT_EQ(back.x, cell.x);
    EXPECT_EQ(back.y, cell.y);
    EXPECT_EQ(back.z, cell.z);
    EXPECT_LT(cellInBlock(cell), kBlockCells);
  }
}

TEST(CellGrid, KeysOfBlocksAreUniqueUpToTheLimits)
{
  std::map<std::uint64_t, GridCoord> seen;
  const std::int32_t values[] = {-kBlockLimit - 1, -kBlockLimit,   -2, -1, 0, 1, 2,
                                 kBlockLimit,      kBlockLimit + 1};
  for (const std::int32_t x : values)
    for (const std::int32_t y : values)
      for (const std::int32_t z : values)
        EXPECT_TRUE(seen.emplace(blockKey({x, y, z}), GridCoord{x, y, z}).second);
}

TEST(CellGrid, RefusesWhatCannotBeNumbered)
{
  const CellGrid grid(0.1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(grid.contains({-1e5F, 0, 4e5F}));
  EXPECT_FALSE(grid.contains({nan, 0, 0}));
  EXPECT_FALSE(grid.contains({0, inf, 0}));
  EXPECT_FALSE(grid.contains({0, 0, -inf}));
  EXPECT_FALSE(grid.contains({5e5F, 0, 0}));
}

TEST(CellGrid, LowerBoundNeverExceedsTheDistanceToPointsInTheCell)
{
  std::mt19937 rng(1);
  for (const float extent : {3.0F, 1000.0F, 30000.0F})
  {
    const CellGrid grid(0.37);
    for (int i = 0; i < 20000; ++i)
    {
      const Point3 p = randomPoint(rng, extent);
      const Point3 offset = randomPoint(rng, 2.0F);
      const Point3 q{p.x + offset.x, p.y + offset.y, p.z + offset.z};
      const GridCoord cell = grid.cellOf(p);
      EXPECT_LE(grid.lowerBound(q, cell, 1), squaredDistance(p, q));
      EXPECT_LE(grid.lowerBound(q, firstCell(blockOf(cell)), kBlockEdge), squaredDistance(p, q));
    }
  }
}

TEST(PointIndex, StaysRightUnderRandomGrowthAndShrinkage)
{
  std::mt19937 rng(2);
  PointIndex index(0.5);
  std::map<std::uint32_t, Point3> truth;
  for (int step = 0; step < 6000; ++step)
  {
    const auto n = static_cast<std::uint32_t>(truth.size());
    const bool grow = n == 0 || rng() % 100 < (step < 3000 ? 70U : 30U);
    if (grow)
    {
      truth[n] = randomPoint(rng, 2.0F);
      index.add(n, truth[n]);
    }
    else
    {
      const auto victim = static_cast<std::uint32_t>(rng() % n);
      index.remove(victim);
      if (victim != n - 1) index.rename(n - 1, victim);
      truth[victim] = truth[n - 1];
      truth.erase(n - 1);
    }
    ASSERT_EQ(index.size(), truth.size());
    if (step % 50 != 0) continue;
    const Point3 q = randomPoint(rng, 2.5F);
    std::set<std::uint32_t> expected;
    for (const auto& [i, p] : truth)
      if (squaredDistance(p, q) <= 1.0F) expected.insert(i);
    ASSERT_EQ(pointsWithin(index, q, 1.0F), expected) << "step " << step;
  }
}

TEST(PointIndex, GivesMemoryBackToItselfAndNotToTheHeap)
{
  PointIndex index(1.0);
  const auto fill = [&](float offset)
  {
    std::mt19937 rng(3);
    for (std::uint32_t i = 0; i < 5000; ++i)
    {
      Point3 p = randomPoint(rng, 20.0F);
      p.x += offset;
      index.add(i, p);
    }
  };
  fill(0);
  for (std::uint32_t i = 0; i < 5000; ++i)
    index.remove(i);
  const std::size_t after_first = index.memoryBytes();
  for (int round = 1; round < 20; ++round)
  {
    fill(100.0F * static_cast<float>(round));
    for (std::uint32_t i = 5000; i-- > 0;)
      index.remove(i);
  }
  EXPECT_EQ(index.size(), 0U);
  EXPECT_LE(index.memoryBytes(), after_first + after_first / 10);
}

TEST(PointIndex, FindsPointsOutsideOfASphere)
{
  std::mt19937 rng(4);
  PointIndex index(0.8);
  std::set<std::uint32_t> expected;
  const double c[3] = {-3, 4, 1}, radius = 9;
  for (std::uint32_t i = 0; i < 20000; ++i)
  {
    const Point3 p = randomPoint(rng, 15.0F);
    index.add(i, p);
    const double dx = p.x - c[0], dy = p.y - c[1], dz = p.z - c[2];
    if (dx * dx + dy * dy + dz * dz > radius * radius) expected.insert(i);
  }
  const auto outside = index.pointsOutside(c[0], c[1], c[2], radius);
  EXPECT_EQ(std::set<std::uint32_t>(outside.begin(), outside.end()), expected);
  EXPECT_EQ(outside.size(), expected.size());
}
