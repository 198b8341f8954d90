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
  for (const float range : {0.5F, 5.0F, 80.0F, 190.0F})
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
  const auto finding = unit.bringToMetres(points);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->defect, RangeDefect::Millimetres);
  EXPECT_NEAR(finding->median, 4000.0, 10.0);
  EXPECT_NEAR(points.x[0], 2.0F, 1e-5F);
  PointColumns near = pointsAt(300.0F);
  EXPECT_FALSE(unit.bringToMetres(near));
  EXPECT_NEAR(near.x[0], 0.15F, 1e-6F);
}

TEST(RangeUnit, CentimetresAreToldButLeftAsTheyAre)
{
  RangeUnit unit;
  PointColumns points = pointsAt(400.0F);
  const auto finding = unit.bringToMetres(points);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->defect, RangeDefect::FarAway);
  EXPECT_NE(describe(*finding).find("400 away"), std::string::npos) << describe(*finding);
  EXPECT_EQ(points.x, pointsAt(400.0F).x);
  EXPECT_FALSE(unit.bringToMetres(points)) << "told once";
}

TEST(RangeUnit, PointsInTheFrameOfAMapAreNoMillimetres)
{
  PointColumns points = pointsAt(10.0F);
  for (float& x : points.x)
    x += 500'000.0F;
  const PointColumns given = points;
  const auto finding = RangeUnit().bringToMetres(points);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->defect, RangeDefect::OneDirection);
  EXPECT_EQ(points.x, given.x);
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
