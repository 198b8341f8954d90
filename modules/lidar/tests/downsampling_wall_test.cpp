// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file downsampling_wall_test.cpp What the thinning does to surfaces: their density and where
 * they appear. */

#include "uneven_lasers.h"
#include <fastlio/lidar/downsampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <unordered_set>

namespace fastlio
{
namespace
{
constexpr double kNoise = 0.02;  // of a range [m]
constexpr double kVoxel = 0.4;   // [m]

void append(PointColumns& points, const Vec3& p)
{
  points.push_back(float(p.x()), float(p.y()), float(p.z()), 0.0F, 0, 0);
}

/** Range to a room whose walls lie at -5, 10 (x), -30, 20 (y), -6 and 15 m (z). */
double rangeInRoom(const Vec3& u)
{
  const double x = u.x() > 0 ? 10.0 / u.x() : -5.0 / u.x();
  const double y = u.y() > 0 ? 20.0 / u.y() : -30.0 / u.y();
  const double z = u.z() > 0 ? 15.0 / u.z() : -6.0 / u.z();
  return std::min({x, y, z});
}

TEST(Downsampler, MakesWallsAtAnyDistanceAboutEquallyDense)
{
  std::mt19937 rng(10);
  std::normal_distribution<double> normal;
  PointColumns points;
  for (int i = 0; i < 2000000; ++i)
  {
    const Vec3 u = Vec3(normal(rng), normal(rng), normal(rng)).normalized();
    append(points, rangeInRoom(u) * u);
  }
  Downsampler downsampler;
  ScanSelection selection;
  downsampler.select(points, {0.5F, 100.0F, 150000}, selection);

  // Points per square metre around the six feet of the perpendicular.
  constexpr double kRadius = 2.5;
  const std::array<Vec3, 6> walls{Vec3(-5, 0, 0), Vec3(10, 0, 0), Vec3(0, -30, 0),
                                  Vec3(0, 20, 0), Vec3(0, 0, -6), Vec3(0, 0, 15)};
  double least = 1e9, most = 0.0;
  for (const Vec3& foot : walls)
  {
    int count = 0;
    for (const std::uint32_t i : selection.indices)
      count += (Vec3(points.x[i], points.y[i], points.z[i]) - foot).norm() < kRadius ? 1 : 0;
    const double density = count / (M_PI * kRadius * kRadius);
    least = std::min(least, density);
    most = std::max(most, density);
  }
  EXPECT_LT(most / least, 1.25);  // 36 before the thinning
  EXPECT_GT(least, 25.0);
}

/** Part of the chosen points that lie on the asphalt of a street. */
double shareOfGround(const PointColumns& points)
{
  Downsampler downsampler;
  ScanSelection selection;
  downsampler.select(points, {0.5F, 100.0F, 1500}, selection);
  const auto ground = std::count_if(
      selection.indices.begin(), selection.indices.end(),
      [&](std::uint32_t i) { return std::abs(points.z[i] + 1.9F) < 0.01F; });
  return double(ground) / double(selection.indices.size());
}

TEST(Downsampler, SeesAsMuchGroundWithFewLasersBelowAsWithMany)
{
  const std::vector<double> even = evenElevations(-25.0, 0.25, 161);  // up to 15 deg
  const double expected = shareOfGround(turnOf(even, 900, rangeInStreet));
  const double share = shareOfGround(turnOf(vlp32cElevations(), 1800, rangeInStreet));
  EXPECT_NEAR(share, expected, 0.25 * expected);
}

/** Compares with a downsampler that does not know the lasers. */
void expectSameChoiceWithoutNumbers(const PointColumns& points)
{
  PointColumns without = points;
  std::fill(without.ring.begin(), without.ring.end(), std::uint16_t{0});
  Downsampler downsampler, other;
  ScanSelection selection, expected;
  for (int scan = 0; scan < 7; ++scan)
  {
    downsampler.select(points, {0.5F, 100.0F, 1500}, selection);
    other.select(without, {0.5F, 100.0F, 1500}, expected);
    EXPECT_EQ(selection.indices, expected.indices);
    EXPECT_FALSE(downsampler.seesSparseLines());
  }
}

TEST(Downsampler, ChoosesAsWithoutNumbersWhereLasersAreEven)
{
  expectSameChoiceWithoutNumbers(turnOf(evenElevations(-15.0, 2.0, 16), 1800, rangeInStreet));
}

TEST(Downsampler, ChoosesAsWithoutNumbersInNarrowPlaces)
{
  const auto in_hall = [](const Vec3& u) { return std::min(11.0, rangeInStreet(u)); };
  expectSameChoiceWithoutNumbers(turnOf(vlp32cElevations(), 1800, in_hall));
}

TEST(Downsampler, ChoosesAsManyPointsWhereLasersAreUneven)
{
  DownsamplingLimits limits{0.5F, 100.0F, 1500};
  limits.wide_range = 20.0F;
  limits.wide_points = 3000;
  PointColumns points = turnOf(vlp32cElevations(), 1800, rangeInStreet);
  Downsampler downsampler, other;
  ScanSelection selection, expected;
  downsampler.select(points, limits, selection);
  EXPECT_TRUE(downsampler.seesSparseLines());
  std::fill(points.ring.begin(), points.ring.end(), std::uint16_t{0});
  other.select(points, limits, expected);
  const auto many = double(expected.indices.size());
  EXPECT_GT(many, 1600.0);
  EXPECT_LT(many, 2900.0);
  EXPECT_NEAR(double(selection.indices.size()), many, 0.1 * many);
}

/** A wall across the x axis, seen from the origin with noisy ranges. */
PointColumns noisyWall(double distance, std::size_t n, std::mt19937& rng)
{
  std::uniform_real_distribution<double> slope(-0.6, 0.6);
  std::normal_distribution<double> noise(0.0, kNoise);
  PointColumns points;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 p = distance * Vec3(1.0, slope(rng), slope(rng));
    append(points, p + noise(rng) * p.normalized());
  }
  return points;
}

struct Offset
{
  double mean = 0.0;
  double standard_error = 0.0;
};

/** Mean distance of points from where the wall is. */
template <class Indices>
Offset offsetOf(const PointColumns& points, const Indices& indices, double distance)
{
  double sum = 0.0, squares = 0.0;
  for (const std::uint32_t i : indices)
  {
    const double e = double(points.x[i]) - distance;
    sum += e;
    squares += e * e;
  }
  const auto n = double(indices.size());
  return {sum / n, std::sqrt((squares / n - sum * sum / n / n) / n)};
}

/** The downsampling that is customary: the first point of every voxel. */
std::vector<std::uint32_t> voxelGrid(const PointColumns& points)
{
  const auto cell = [](float v) { return std::uint64_t(std::floor(v / kVoxel) + 4096.0); };
  std::unordered_set<std::uint64_t> seen;
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    const std::uint64_t key =
        (cell(points.x[i]) << 40U) | (cell(points.y[i]) << 20U) | cell(points.z[i]);
    if (seen.insert(key).second) first.push_back(i);
  }
  return first;
}

TEST(Downsampler, DoesNotShiftNoisyWalls)
{
  std::mt19937 rng(11);
  Downsampler downsampler;
  ScanSelection selection;
  for (double distance = 2.0; distance < 40.0; distance *= 1.07)
  {
    double sum = 0.0, variance = 0.0;
    constexpr int kScans = 10;
    for (int k = 0; k < kScans; ++k)
    {
      const PointColumns points = noisyWall(distance, 20000, rng);
      downsampler.select(points, {0.5F, 100.0F, 1500}, selection);
      const Offset offset = offsetOf(points, selection.indices, distance);
      sum += offset.mean;
      variance += offset.standard_error * offset.standard_error;
    }
    // A probability that grows with r^2 prefers long ranges by 2 sigma^2/r: the noise cannot do
    // more.
    const double preference = 2.0 * kNoise * kNoise / distance;
    EXPECT_NEAR(sum / kScans, 0.0, 4.0 * std::sqrt(variance) / kScans + preference) << distance;
  }
}

TEST(Downsampler, AVoxelGridWouldShiftThem)
{
  // The reason for this kind of downsampling, and proof that the test above detects its absence.
  std::mt19937 rng(12);
  const double distance = 25 * kVoxel + kNoise;  // just behind the face of a voxel
  const PointColumns points = noisyWall(distance, 60000, rng);
  const Offset grid = offsetOf(points, voxelGrid(points), distance);
  EXPECT_LT(grid.mean, -0.25 * kNoise);
  EXPECT_LT(grid.mean, -6.0 * grid.standard_error);

  Downsampler downsampler;
  ScanSelection selection;
  downsampler.select(points, {0.5F, 100.0F, voxelGrid(points).size()}, selection);
  const Offset thinned = offsetOf(points, selection.indices, distance);
  EXPECT_LT(std::abs(thinned.mean), 4.0 * thinned.standard_error);
}
}  // namespace
}  // namespace fastlio
