// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "uneven_lasers.h"
#include <fastlio/lidar/laser_widths.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
double tenMetres(const Vec3& /*u*/)
{
  return 10.0;
}

LaserWidths learned(const PointColumns& points)
{
  LaserWidths widths;
  widths.learn(points);
  return widths;
}

TEST(LaserWidths, AreTheSolidAnglesBetweenTheNeighbours)
{
  const std::vector<double> elevations = vlp32cElevations();
  const LaserWidths widths = learned(turnOf(elevations, 900, rangeInStreet));
  ASSERT_EQ(widths.relative().size(), elevations.size());
  std::vector<double> sines;
  sines.reserve(elevations.size());
  for (const double elevation : elevations)
    sines.push_back(std::sin(elevation / kDegPerRad));
  std::sort(sines.begin(), sines.end());
  // Half of the gaps at both ends are beyond the lasers.
  const double mean =
      (sines[31] - sines[0] + 0.5 * (sines[1] - sines[0] + sines[31] - sines[30])) / 32.0;
  const auto sine = [](double deg) { return std::sin(deg / kDegPerRad); };
  EXPECT_NEAR(widths.of(0), (sine(-15.639) - sine(-25.0)) / mean, 1e-3);
  EXPECT_NEAR(widths.of(3), (sine(-11.31) - sine(-25.0)) / 2.0 / mean, 1e-3);
  EXPECT_NEAR(widths.of(5), (sine(0.333) - sine(-0.333)) / 2.0 / mean, 1e-3);
  EXPECT_NEAR(widths.of(29), (sine(15.0) - sine(10.333)) / mean, 1e-3);
  double sum = 0.0;
  for (const float width : widths.relative())
    sum += double(width);
  EXPECT_NEAR(sum / 32.0, 1.0, 1e-5);
}

TEST(LaserWidths, AreNotGivenForEvenLasers)
{
  EXPECT_TRUE(learned(turnOf(evenElevations(-15.0, 2.0, 16), 900, tenMetres)).relative().empty());
  EXPECT_TRUE(learned(turnOf(evenElevations(-45.0, 0.7, 128), 900, tenMetres)).relative().empty());
  std::mt19937 rng(3);
  std::normal_distribution<double> tolerance(0.0, 0.1);
  std::vector<double> elevations = evenElevations(-22.5, 0.7, 64);
  for (double& elevation : elevations)
    elevation += tolerance(rng);
  EXPECT_TRUE(learned(turnOf(elevations, 900, tenMetres)).relative().empty());
  // Some lasers look into the sky, between others that meet trees.
  PointColumns seen;
  const PointColumns all = turnOf(elevations, 900, tenMetres);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all.ring[i] < 40 || all.ring[i] > 60)
      seen.push_back(all.x[i], all.y[i], all.z[i], 0.0F, 0, all.ring[i]);
  EXPECT_TRUE(learned(seen).relative().empty());
  LaserWidths widths;
  EXPECT_EQ(widths.of(7), 1.0F);
}

TEST(LaserWidths, AreNotGivenWhereBeamsWander)
{
  // The six beams of a rosette, and two LiDARs in one cloud whose lines have the same numbers.
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> wanders(-35.0, 35.0);
  PointColumns rosette;
  for (int i = 0; i < 3000; ++i)
  {
    const std::vector<double> beams(6, wanders(rng));
    const PointColumns shots = turnOf(beams, 1, tenMetres);
    for (std::size_t k = 0; k < shots.size(); ++k)
      rosette.push_back(shots.x[k], shots.y[k], shots.z[k], 0.0F, 0, shots.ring[k]);
  }
  EXPECT_TRUE(learned(rosette).relative().empty());
  const std::vector<double> elevations = vlp32cElevations();
  PointColumns two = turnOf(elevations, 900, tenMetres);
  const PointColumns other = turnOf(elevations, 900, tenMetres);
  for (std::size_t k = 0; k < other.size(); ++k)  // lies on its side
    two.push_back(other.z[k], other.y[k], -other.x[k], 0.0F, 0, other.ring[k]);
  EXPECT_TRUE(learned(two).relative().empty());
}

TEST(LaserWidths, NeedTheNumbersOfLasers)
{
  PointColumns points = turnOf(vlp32cElevations(), 900, tenMetres);
  std::fill(points.ring.begin(), points.ring.end(), std::uint16_t{0});
  EXPECT_TRUE(learned(points).relative().empty());
  for (std::size_t i = 0; i < points.size(); ++i)  // a number for each point
    points.ring[i] = static_cast<std::uint16_t>(i);
  EXPECT_TRUE(learned(points).relative().empty());
  EXPECT_TRUE(learned({}).relative().empty());
}

TEST(LaserWidths, TakeNoNoticeOfPointsWithoutAPlace)
{
  const std::vector<double> elevations = vlp32cElevations();
  PointColumns points = turnOf(elevations, 900, rangeInStreet);
  const LaserWidths expected = learned(points);
  for (std::size_t i = 0; i < points.size(); i += 3)
    points.x[i] = points.y[i] = points.z[i] =
        i % 2 == 0 ? 0.0F : std::numeric_limits<float>::quiet_NaN();
  const LaserWidths widths = learned(points);
  ASSERT_EQ(widths.relative().size(), elevations.size());
  for (std::size_t laser = 0; laser < elevations.size(); ++laser)
    EXPECT_NEAR(widths.relative()[laser], expected.relative()[laser], 1e-4);
}

TEST(LaserWidths, LeaveSomethingToLasersThatShareAnElevation)
{
  std::vector<double> elevations = vlp32cElevations();
  elevations.insert(elevations.end(), {-3.0, -3.0, 0.0, 0.0});
  const LaserWidths widths = learned(turnOf(elevations, 900, tenMetres));
  ASSERT_EQ(widths.relative().size(), elevations.size());
  EXPECT_GT(*std::min_element(widths.relative().begin(), widths.relative().end()), 0.05F);
}
}  // namespace
}  // namespace fastlio
