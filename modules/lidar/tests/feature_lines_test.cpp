// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file feature_lines_test.cpp Points by scan line, with and without rings. */

#include "feature_scans.h"
#include <fastlio/lidar/feature_lines.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace fastlio::testing
{
namespace
{
std::vector<std::uint32_t> allOf(const PointColumns& points)
{
  std::vector<std::uint32_t> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

std::vector<std::uint32_t> lineAt(const ScanLines& lines, std::size_t k)
{
  return {lines.order.begin() + lines.begin[k], lines.order.begin() + lines.begin[k + 1]};
}

/** Every usable point is in exactly one line, and lines run in the order of time. */
void expectPartition(
    const PointColumns& points, const std::vector<std::uint32_t>& usable, const ScanLines& lines)
{
  std::vector<std::uint32_t> sorted = lines.order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, usable);
  EXPECT_EQ(lines.begin.front(), 0U);
  EXPECT_EQ(lines.begin.back(), usable.size());
  for (std::size_t k = 0; k < lines.count(); ++k)
  {
    const auto line = lineAt(lines, k);
    EXPECT_FALSE(line.empty());
    for (std::size_t i = 1; i < line.size(); ++i)
      EXPECT_LE(points.time_offset_ns[line[i - 1]], points.time_offset_ns[line[i]]);
  }
}

/** A single beam that draws a spiral. */
PointColumns spiral()
{
  PointColumns points;
  for (int k = 0; k < 3000; ++k)
  {
    const double angle = 0.005 * k, radius = 1.0 + 2e-4 * k;
    points.push_back(
        5.0F, static_cast<float>(radius * std::cos(angle)),
        static_cast<float>(radius * std::sin(angle)), 0.0F, 1000 * k, 0);
  }
  return points;
}

TEST(ScanLines, FollowTheRings)
{
  const PointColumns points = spin(roomRange(4, 6, 0.3));
  const auto usable = allOf(points);
  ScanLineSorter sorter;
  ScanLines lines;
  EXPECT_EQ(sorter.sort(points, usable, ScanLineOrder::Automatic, lines), ScanLineOrder::Ring);
  ASSERT_EQ(lines.count(), 8U);
  expectPartition(points, usable, lines);
  for (std::size_t k = 0; k < lines.count(); ++k)
    for (const std::uint32_t i : lineAt(lines, k))
      EXPECT_EQ(points.ring[i], k);
}

TEST(ScanLines, FollowTheElevationsWhereRingsAreUnknown)
{
  Spin sensor;
  const PointColumns with_rings = spin(roomRange(4, 6, 0.3), sensor);
  sensor.with_rings = false;
  const PointColumns points = spin(roomRange(4, 6, 0.3), sensor);
  const auto usable = allOf(points);
  ScanLineSorter sorter;
  ScanLines lines, expected;
  EXPECT_EQ(sorter.sort(points, usable, ScanLineOrder::Automatic, lines), ScanLineOrder::Elevation);
  sorter.sort(with_rings, usable, ScanLineOrder::Ring, expected);
  EXPECT_EQ(lines.begin, expected.begin);
  EXPECT_EQ(lines.order, expected.order);
}

TEST(ScanLines, ASingleBeamIsOneLine)
{
  const PointColumns points = spiral();
  ScanLineSorter sorter;
  ScanLines lines;
  EXPECT_EQ(
      sorter.sort(points, allOf(points), ScanLineOrder::Automatic, lines), ScanLineOrder::Time);
  EXPECT_EQ(lines.count(), 1U);
  expectPartition(points, allOf(points), lines);
}

TEST(ScanLines, AreInTheOrderOfTimeWhateverTheOrderInTheScan)
{
  const PointColumns original = spin(roomRange(4, 6, 0.3));
  auto order = allOf(original);
  std::mt19937 rng(2);
  std::shuffle(order.begin(), order.end(), rng);
  const PointColumns points = permuted(original, order);
  ScanLineSorter sorter;
  ScanLines lines;
  sorter.sort(points, allOf(points), ScanLineOrder::Automatic, lines);
  expectPartition(points, allOf(points), lines);
  for (std::size_t k = 0; k < lines.count(); ++k)
    for (const std::uint32_t i : lineAt(lines, k))
      EXPECT_EQ(points.ring[i], k);
}

TEST(ScanLines, TakeTheUsablePointsOnly)
{
  const PointColumns points = spin(roomRange(4, 6, 0.3));
  std::vector<std::uint32_t> usable;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (points.ring[i] != 3 && i % 7 != 0) usable.push_back(i);
  ScanLineSorter sorter;
  ScanLines lines;
  sorter.sort(points, usable, ScanLineOrder::Ring, lines);
  EXPECT_EQ(lines.count(), 7U);
  expectPartition(points, usable, lines);
}

TEST(ScanLines, TakeAnyRingAndNoPoints)
{
  PointColumns points;
  points.push_back(1, 0, 0, 0, 0, 65535);
  points.push_back(0, 1, 0, 0, 0, 7);
  points.push_back(0, 0, 1, 0, 0, 65535);
  points.push_back(0, 0, -1, 0, 0, 0);
  ScanLineSorter sorter;
  ScanLines lines;
  sorter.sort(points, allOf(points), ScanLineOrder::Ring, lines);
  EXPECT_EQ(lines.count(), 3U);
  expectPartition(points, allOf(points), lines);
  sorter.sort(points, allOf(points), ScanLineOrder::Elevation, lines);
  EXPECT_EQ(lines.count(), 3U);  // straight up, straight down, level
  expectPartition(points, allOf(points), lines);

  for (const auto wanted : {ScanLineOrder::Automatic, ScanLineOrder::Time, ScanLineOrder::Ring})
  {
    sorter.sort(points, {}, wanted, lines);
    EXPECT_EQ(lines.count(), 0U);
    EXPECT_TRUE(lines.order.empty());
  }
}
}  // namespace
}  // namespace fastlio::testing
