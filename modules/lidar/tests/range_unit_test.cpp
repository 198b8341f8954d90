// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/range_unit.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
/** Points around the sensor, from half of a range to one and a half of it. */
PointColumns pointsAt(float range, int count = 1000)
{
  PointColumns points;
  for (int i = 0; i < count; ++i)
  {
    const float angle = 0.1F * static_cast<float>(i);
    const float r = range * (0.5F + static_cast<float>(i) / static_cast<float>(count));
    points.push_back(r * std::cos(angle), r * std::sin(angle), 0.0F, 1.0F, 0, 0);
  }
  return points;
}

TEST(RangeUnit, MetresStayAsTheyAre)
{
  for (const float range : {0.5F, 5.0F, 80.0F, 600.0F})
  {
    RangeUnit unit;
    PointColumns points = pointsAt(range);
    EXPECT_FALSE(unit.bringToMetres(points)) << range;
    EXPECT_EQ(points.x, pointsAt(range).x);
  }
}

TEST(RangeUnit, MillimetresAreReportedOnceAndScaledEverAfter)
{
  RangeUnit unit;
  PointColumns points = pointsAt(4000.0F);
  const auto median = unit.bringToMetres(points);
  ASSERT_TRUE(median);
  EXPECT_NEAR(*median, 4000.0, 10.0);
  EXPECT_NEAR(points.x[0], 2.0F, 1e-5F);
  PointColumns near = pointsAt(300.0F);
  EXPECT_FALSE(unit.bringToMetres(near));
  EXPECT_NEAR(near.x[0], 0.15F, 1e-6F);
}

TEST(RangeUnit, TheFirstScanWithEnoughPointsDecides)
{
  RangeUnit unit;
  PointColumns few = pointsAt(4000.0F, 50);
  EXPECT_FALSE(unit.bringToMetres(few));
  PointColumns no_points = pointsAt(4000.0F);
  for (std::size_t i = 0; i < no_points.size(); ++i)
    no_points.x[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                : std::numeric_limits<float>::infinity();
  EXPECT_FALSE(unit.bringToMetres(no_points));
  PointColumns metres = pointsAt(4.0F);
  EXPECT_FALSE(unit.bringToMetres(metres));
  PointColumns far = pointsAt(4000.0F);
  EXPECT_FALSE(unit.bringToMetres(far));
  EXPECT_EQ(far.x, pointsAt(4000.0F).x) << "it has been decided";
}

}  // namespace
}  // namespace fastlio
