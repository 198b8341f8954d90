// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Times out of azimuths, for clouds in the order of their columns and of their lines.

#include <fastlio/lidar/sweep_time.h>
#include <fastlio/math/angles.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace fastlio
{
namespace
{
constexpr int kLines = 16, kColumns = 500;

/** One revolution with true times of 0.1 s from the start. \param stagger of the lines [rad] */
PointColumns revolution(int sense, double start, bool line_by_line, double stagger = 0.0)
{
  PointColumns points;
  for (int i = 0; i < kLines * kColumns; ++i)
  {
    const int column = line_by_line ? i % kColumns : i / kLines;
    const int line = line_by_line ? i / kColumns : i % kLines;
    const double fraction = static_cast<double>(column) / kColumns;
    const double azimuth = start + sense * kTwoPi * fraction + stagger * (line % 4 - 1.5);
    const double range = 5.0 + std::sin(3.0 * azimuth);
    points.push_back(
        static_cast<float>(range * std::cos(azimuth)),
        static_cast<float>(range * std::sin(azimuth)), 0.1F * static_cast<float>(line), 0.0F,
        static_cast<std::int32_t>(fraction * 1e8), static_cast<std::uint16_t>(line));
  }
  return points;
}

struct Case
{
  int sense;
  double start;
  bool line_by_line;
  double stagger;
};

class Revolution : public ::testing::TestWithParam<Case>
{
};
}  // namespace

TEST_P(Revolution, TimesComeBack)
{
  const Case& c = GetParam();
  const PointColumns truth = revolution(c.sense, c.start, c.line_by_line, c.stagger);
  const SweepShape shape = shapeOf(truth);
  EXPECT_TRUE(shape.spinning) << describe(shape);
  EXPECT_EQ(shape.sense, c.sense);
  EXPECT_NEAR(std::remainder(shape.start_azimuth - c.start, kTwoPi), 0.0, 0.06);
  for (const auto& [reference, shift] :
       {std::pair{PointTimeReference::Start, 0}, std::pair{PointTimeReference::Middle, -50'000'000},
        std::pair{PointTimeReference::End, -100'000'000}})
  {
    PointColumns points = truth;
    assignSweepTimes(points, {shape.sense, shape.start_azimuth, 0.1, reference});
    int wrong = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::abs(points.time_offset_ns[i] - shift - truth.time_offset_ns[i]) > 1'200'000) ++wrong;
    // Line by line, the order does not show to which side of the seam a staggered point belongs.
    EXPECT_LT(wrong, c.line_by_line ? 0.02 * kLines * kColumns : 1) << describe(shape);
  }
}

INSTANTIATE_TEST_SUITE_P(
    SweepTime, Revolution,
    ::testing::Values(
        Case{1, 0.0, false, 0.0}, Case{-1, 3.0, false, 0.0}, Case{-1, -1.0, false, 0.02},
        Case{1, 0.5, true, 0.0}, Case{-1, 3.1, true, 0.0}, Case{-1, 2.0, true, 0.02}));

TEST(SweepTime, WhatDoesNotTurnIsNotTakenForASweep)
{
  PointColumns points;
  for (int i = 0; i < 4000; ++i)  // a rosette in front of the sensor
    points.push_back(
        5.0F, static_cast<float>(2.0 * std::sin(0.77 * i)), static_cast<float>(std::cos(0.31 * i)),
        0.0F, 0, 0);
  EXPECT_FALSE(shapeOf(points).spinning);

  const PointColumns ordered = revolution(1, 0.0, false);
  PointColumns shuffled;  // all around, but in no order
  std::vector<std::size_t> order(ordered.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  for (const std::size_t from : order)
    shuffled.push_back(ordered.x[from], ordered.y[from], ordered.z[from], 0.0F, 0, 0);
  EXPECT_FALSE(shapeOf(shuffled).spinning) << describe(shapeOf(shuffled));
  EXPECT_FALSE(shapeOf(PointColumns{}).spinning);
}

}  // namespace fastlio
