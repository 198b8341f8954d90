// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/scan.h>

#include <gtest/gtest.h>

#include <limits>

namespace fastlio
{
namespace
{
PointColumns twoPoints()
{
  PointColumns points;
  points.push_back(1.0F, 2.0F, 3.0F, 40.0F, 500, 6);
  points.push_back(-1.0F, -2.0F, -3.0F, 0.0F, -700, 127);
  return points;
}

TEST(PointColumns, KeepEachPointInOneRowOfAllColumns)
{
  const PointColumns points = twoPoints();
  EXPECT_EQ(points.size(), 2U);
  EXPECT_EQ(points.x, (std::vector<float>{1.0F, -1.0F}));
  EXPECT_EQ(points.y, (std::vector<float>{2.0F, -2.0F}));
  EXPECT_EQ(points.z, (std::vector<float>{3.0F, -3.0F}));
  EXPECT_EQ(points.intensity, (std::vector<float>{40.0F, 0.0F}));
  EXPECT_EQ(points.time_offset_ns, (std::vector<std::int32_t>{500, -700}));
  EXPECT_EQ(points.ring, (std::vector<std::uint16_t>{6, 127}));
}

TEST(PointColumns, ReserveMakesRoomInAllColumnsAndNoPoints)
{
  PointColumns points;
  points.reserve(100);
  EXPECT_EQ(points.size(), 0U);
  EXPECT_GE(points.x.capacity(), 100U);
  EXPECT_GE(points.y.capacity(), 100U);
  EXPECT_GE(points.z.capacity(), 100U);
  EXPECT_GE(points.intensity.capacity(), 100U);
  EXPECT_GE(points.time_offset_ns.capacity(), 100U);
  EXPECT_GE(points.ring.capacity(), 100U);
}

TEST(PointColumns, ClearEmptiesAllColumns)
{
  PointColumns points = twoPoints();
  points.clear();
  EXPECT_EQ(points.size(), 0U);
  EXPECT_TRUE(points.y.empty() && points.z.empty() && points.intensity.empty());
  EXPECT_TRUE(points.time_offset_ns.empty() && points.ring.empty());
}

TEST(ScanSpan, OfAnEmptyScanIsItsStamp)
{
  LidarScan scan;
  scan.stamp_ns = 1'700'000'000'123'456'789;
  EXPECT_EQ(spanOf(scan).begin_ns, scan.stamp_ns);
  EXPECT_EQ(spanOf(scan).end_ns, scan.stamp_ns);
}

TEST(ScanSpan, ReachesFromEarliestToLatestPointInAnyOrder)
{
  LidarScan scan;
  scan.stamp_ns = 1'700'000'000'000'000'000;
  for (const std::int32_t offset : {300, -20, 99'999'999, 7})
    scan.points.push_back(1.0F, 0.0F, 0.0F, 0.0F, offset, 0);
  EXPECT_EQ(spanOf(scan).begin_ns, scan.stamp_ns - 20);
  EXPECT_EQ(spanOf(scan).end_ns, scan.stamp_ns + 99'999'999);
}

TEST(ScanSpan, NeedNotHoldTheStamp)
{
  // A driver may stamp the end of a sweep or, off by its clock, anything near it.
  LidarScan scan;
  scan.stamp_ns = 1'000'000'000;
  scan.points.push_back(1.0F, 0.0F, 0.0F, 0.0F, -900, 0);
  scan.points.push_back(1.0F, 0.0F, 0.0F, 0.0F, -100, 0);
  EXPECT_EQ(spanOf(scan).begin_ns, 999'999'100);
  EXPECT_EQ(spanOf(scan).end_ns, 999'999'900);
}

TEST(ScanSpan, HoldsTheExtremesOfTheOffsets)
{
  LidarScan scan;
  scan.stamp_ns = 1'700'000'000'000'000'000;
  for (const std::int32_t offset :
       {std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()})
    scan.points.push_back(1.0F, 0.0F, 0.0F, 0.0F, offset, 0);
  EXPECT_EQ(spanOf(scan).end_ns - spanOf(scan).begin_ns, 4'294'967'295);
}
}  // namespace
}  // namespace fastlio
