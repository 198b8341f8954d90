// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "surface_map_test_tools.h"
#include <fastlio/map/edge_map.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
/** Points every \a step along a line, scattered by \a noise about it. */
Cloud lineCloud(
    const Vec3& point, const Vec3& direction, double length, double step, double noise,
    unsigned seed)
{
  std::mt19937 rng(seed);
  std::normal_distribution<double> normal(0.0, noise > 0.0 ? noise : 1.0);
  Cloud cloud;
  for (double s = -0.5 * length; s <= 0.5 * length; s += step)
  {
    Vec3 p = point + s * direction;
    if (noise > 0.0) p += Vec3(normal(rng), normal(rng), normal(rng));
    cloud.add({float(p.x()), float(p.y()), float(p.z())});
  }
  return cloud;
}

EdgeMap edgesOf(const Cloud& cloud, const EdgeMapOptions& options = {})
{
  EdgeMap map(options);
  map.insert(worldPoints(cloud));
  return map;
}

LineMatch matchOf(const EdgeMap& map, const Vec3& query)
{
  const WorldPoints points = worldPoints({{float(query.x()), float(query.y()), float(query.z())}});
  std::vector<LineMatch> matches(1);
  map.match(points, 0, 1, matches);
  return matches.front();
}

Vec3 directionOf(const LineMatch& m)
{
  return {m.ux, m.uy, m.uz};
}
Vec3 footOf(const LineMatch& m)
{
  return {m.qx, m.qy, m.qz};
}
}  // namespace

TEST(EdgeMap, FindsLinesOfAnyDirection)
{
  std::mt19937 rng(1);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(rng), normal(rng), normal(rng)); };
  for (int trial = 0; trial < 200; ++trial)
  {
    const Vec3 point = 50.0 * vector(), direction = vector().normalized();
    const EdgeMap map = edgesOf(lineCloud(point, direction, 6.0, 0.25, 0.0, 1));
    const Vec3 across = direction.cross(vector()).normalized();
    const Vec3 query = point + 0.7 * direction + 0.3 * across;
    const LineMatch m = matchOf(map, query);
    ASSERT_TRUE(m.valid()) << trial;
    EXPECT_NEAR(directionOf(m).norm(), 1.0, 1e-6);
    EXPECT_GT(std::abs(directionOf(m).dot(direction)), 1.0 - 1e-6);
    EXPECT_LT((footOf(m) - (point + 0.7 * direction)).norm(), 1e-3);  // foot of the perpendicular
  }
}

TEST(EdgeMap, MatchesOnlyWhereThereIsALine)
{
  const Vec3 origin = Vec3::Zero(), far_away(100, 0, 0);
  EXPECT_FALSE(matchOf(EdgeMap(), origin).valid());
  const Cloud four{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}};
  EXPECT_FALSE(matchOf(edgesOf(four), origin).valid());
  const Cloud cross{{0, 0, 0}, {0.5F, 0, 0}, {-0.5F, 0, 0}, {0, 0.5F, 0}, {0, -0.5F, 0}};
  EXPECT_FALSE(matchOf(edgesOf(cross), origin).valid());
  const Cloud bent{{0, 0, 0}, {0.4F, 0.4F, 0}, {0.8F, 0, 0}, {1.2F, 0.4F, 0}, {1.6F, 0, 0}};
  EXPECT_FALSE(matchOf(edgesOf(bent), origin).valid());
  const EdgeMap line = edgesOf(lineCloud(origin, Vec3::UnitZ(), 4.0, 0.25, 0.0, 1));
  EXPECT_TRUE(matchOf(line, origin).valid());
  EXPECT_FALSE(matchOf(line, far_away).valid());
  EXPECT_FALSE(matchOf(line, Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)).valid());
}

TEST(EdgeMap, SaysHowFarPointsOfAnEdgeScatterAboutItsLine)
{
  // Normalised squares of both coordinates of fresh points across the line have the mean 1.
  constexpr double kNoise = 0.03;
  EdgeMapOptions options;
  options.point_noise = kNoise;
  std::mt19937 rng(4);
  std::normal_distribution<double> noise(0.0, kNoise);
  double squares = 0.0;
  int count = 0;
  for (unsigned trial = 0; trial < 3000; ++trial)
  {
    const EdgeMap map =
        edgesOf(lineCloud(Vec3(3, -2, 1), Vec3::UnitZ(), 3.0, 0.3, kNoise, trial), options);
    const Vec3 query = Vec3(3, -2, 1.1) + Vec3(noise(rng), noise(rng), noise(rng));
    const LineMatch m = matchOf(map, query);
    if (!m.valid()) continue;
    squares += (query - footOf(m)).squaredNorm() / double(m.variance);
    count += 2;
  }
  ASSERT_GT(count, 5000);
  EXPECT_NEAR(squares / count, 1.0, 0.15);
}

TEST(EdgeMap, TrustsAnExtrapolatedLineLess)
{
  const EdgeMap map = edgesOf(lineCloud(Vec3::Zero(), Vec3::UnitZ(), 4.0, 0.25, 0.01, 3));
  const LineMatch inside = matchOf(map, Vec3::Zero()), beyond = matchOf(map, Vec3(0, 0, 3.0));
  ASSERT_TRUE(inside.valid());
  ASSERT_TRUE(beyond.valid());
  EXPECT_GT(beyond.variance, 2.0F * inside.variance);
}

TEST(EdgeMap, KeepsTheSpacingAndForgetsWhatIsFar)
{
  EdgeMapOptions options;
  options.min_spacing = 0.5;
  EdgeMap map(options);
  const Cloud dense = lineCloud(Vec3::Zero(), Vec3::UnitX(), 100.0, 0.05, 0.0, 1);
  map.insert(worldPoints(dense));
  const std::size_t held = map.pointCount();
  EXPECT_LE(held, 201U);
  EXPECT_GT(held, 180U);
  map.insert(worldPoints(dense));
  EXPECT_EQ(map.pointCount(), held);
  map.removeOutside(Vec3(-50, 0, 0), 20.0);
  EXPECT_LT(map.pointCount(), 45U);
  EXPECT_TRUE(matchOf(map, Vec3(-45, 0.1, 0)).valid());
  EXPECT_FALSE(matchOf(map, Vec3(30, 0.1, 0)).valid());
}

TEST(EdgeMap, RefusesOptionsAndRangesOutOfBounds)
{
  EdgeMapOptions options;
  options.min_spacing = -0.1;
  EXPECT_THROW(EdgeMap{options}, std::invalid_argument);
  options = {};
  options.point_noise = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(EdgeMap{options}, std::invalid_argument);
  const EdgeMap map;
  std::vector<LineMatch> matches(1);
  EXPECT_THROW(
      map.match(worldPoints({{0, 0, 0}, {1, 0, 0}}), 0, 2, matches), std::invalid_argument);
}
