// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "surface_map_test_tools.h"
#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/plane_fit.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <thread>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
KnnSurfaceMap surfacesOf(const Cloud& cloud, const KnnSurfaceMapOptions& options = {})
{
  KnnSurfaceMap map(options);
  map.insert(worldPoints(cloud), Vec3::Zero());
  return map;
}
}  // namespace

TEST(KnnSurfaceMap, FindsTheWallsOfARoom)
{
  const KnnSurfaceMap map = surfacesOf(roomCloud(1, 60000));
  const Cloud queries{{-20, 3, 0.5F}, {20.05F, -4, -1}, {5, 12, 0}, {5, -11.9F, 0}, {1, 2, -3}};
  const Eigen::Vector3d normals[] = {
      Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
      Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const double offsets[] = {0, 0.05, 0, 0.1, 0};
  const auto matches = matchAll(map, worldPoints(queries));
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    const PlaneMatch& m = matches[i];
    ASSERT_TRUE(m.valid()) << i;
    EXPECT_NEAR(Eigen::Vector3d(m.nx, m.ny, m.nz).norm(), 1.0, 1e-6);
    EXPECT_GT(std::abs(Eigen::Vector3d(m.nx, m.ny, m.nz).dot(normals[i])), 0.995) << i;
    EXPECT_NEAR(std::abs(residual(m, queries.points[i])), offsets[i], 0.03) << i;
    EXPECT_GT(m.variance, 0.0F);
    EXPECT_LT(m.variance, 0.02F * 0.02F);
  }
}

TEST(KnnSurfaceMap, MatchesOnlyWhereThereIsAPlane)
{
  const Cloud queries{{0, 0, 0}, {100, 0, 0}, {0, 0, std::numeric_limits<float>::quiet_NaN()}};
  // Empty map, too few points, points around a corner, points on a line, too far away.
  EXPECT_FALSE(matchAll(KnnSurfaceMap(), worldPoints(queries))[0].valid());
  const Cloud four{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(matchAll(surfacesOf(four), worldPoints(queries))[0].valid());
  const Cloud rough{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5F, 0.5F, 0.9F}};
  EXPECT_FALSE(matchAll(surfacesOf(rough), worldPoints(queries))[0].valid());
  const Cloud line{{0, 0, 0}, {0.5F, 0, 0}, {1, 0, 0}, {1.5F, 0, 0}, {-0.5F, 0, 0}};
  EXPECT_FALSE(matchAll(surfacesOf(line), worldPoints(queries))[0].valid());
  const Cloud flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5F, 0.5F, 0.01F}};
  const auto matches = matchAll(surfacesOf(flat), worldPoints(queries));
  EXPECT_TRUE(matches[0].valid());
  EXPECT_FALSE(matches[1].valid());
  EXPECT_FALSE(matches[2].valid());
}

TEST(KnnSurfaceMap, VarianceGrowsWithTheDistanceFromTheNeighbors)
{
  const Cloud strip{{0, 0, 0}, {0.5F, 0.05F, 0}, {1, -0.05F, 0}, {1.5F, 0.05F, 0}, {2, 0, 0}};
  const KnnSurfaceMap map = surfacesOf(strip);
  const Cloud queries{{1, 0, 0}, {1, 0.3F, 0}, {1, 1, 0}};
  const auto matches = matchAll(map, worldPoints(queries));
  ASSERT_TRUE(matches[0].valid() && matches[1].valid() && matches[2].valid());
  EXPECT_LT(5 * matches[0].variance, matches[1].variance);
  EXPECT_LT(5 * matches[1].variance, matches[2].variance);
}

// The variance is a promise: residuals of points on the true surface, divided by it, have unit mean
// square when the map's noise is what the options say.
TEST(KnnSurfaceMap, VarianceIsThatOfTheOffset)
{
  KnnSurfaceMapOptions options;
  options.point_noise = 0.01;
  const KnnSurfaceMap map = surfacesOf(roomCloud(2, 200000), options);
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> u(-1, 1);
  Cloud queries;
  for (int i = 0; i < 4000; ++i)
    queries.add({17 * u(rng), 9 * u(rng), -3});
  const auto matches = matchAll(map, worldPoints(queries));
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    if (!matches[i].valid()) continue;
    const double z = residual(matches[i], queries.points[i]);
    sum += z * z / matches[i].variance;
    ++count;
  }
  EXPECT_GT(count, queries.size() * 9 / 10);
  EXPECT_NEAR(sum / double(count), 1.0, 0.15);
}

// The plane of each query by the definition: nearest points by looking at all of them.
TEST(KnnSurfaceMap, PlanesAreThoseOfTheNearestPoints)
{
  KnnSurfaceMapOptions options;
  options.min_spacing = 0.3;
  KnnSurfaceMap map(options);
  for (unsigned step = 0; step < 6; ++step)
  {
    const float shift = 8.0F * static_cast<float>(step);
    Cloud scan = roomCloud(step, 20000);
    for (Xyz& p : scan.points)
      p.x += shift;
    map.insert(worldPoints(scan), Vec3::Zero());
    map.removeOutside({shift, 0, 0}, 25.0);
    Cloud queries = randomCloud(10 + step, 100, 20.0F);
    for (const Xyz& p : roomCloud(20 + step, 200).points)
      queries.add({p.x + shift, p.y, p.z});
    const auto matches = matchAll(map, worldPoints(queries));
    std::size_t valid = 0;
    for (std::size_t i = 0; i < queries.size(); ++i)
    {
      const Xyz& q = queries.points[i];
      std::vector<Eigen::Vector3d> near;
      for (const Neighbor& n : bruteForce(
               map.pointsMap(), q, KnnSurfaceMap::kNeighbors, KnnSurfaceMap::kMaxNeighborDistance))
        near.emplace_back(double(n.x) - q.x, double(n.y) - q.y, double(n.z) - q.z);
      const auto fit = fitPlane(momentsOf(near.data(), near.size()));
      const bool is_plane =
          near.size() == KnnSurfaceMap::kNeighbors && fit &&
          std::all_of(
              near.begin(), near.end(),
              [&](const Eigen::Vector3d& p)
              { return std::abs(fit->distance(p)) <= KnnSurfaceMap::kMaxPlaneDistance; });
      ASSERT_EQ(matches[i].valid(), is_plane) << i;
      if (!is_plane) continue;
      ++valid;
      const Eigen::Vector3d normal(matches[i].nx, matches[i].ny, matches[i].nz);
      ASSERT_GT(std::abs(normal.dot(fit->normal)), 1.0 - 1e-6);
      ASSERT_NEAR(std::abs(residual(matches[i], q)), std::abs(fit->distance(Vec3::Zero())), 1e-5);
    }
    EXPECT_GT(valid, 100U);
  }
}

TEST(KnnSurfaceMap, RangesAreMatchedInParallel)
{
  const KnnSurfaceMap map = surfacesOf(roomCloud(4, 20000));
  const WorldPoints queries = worldPoints(roomCloud(5, 4000));
  const auto expected = matchAll(map, queries);
  std::vector<PlaneMatch> matches(queries.size());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t]
                         { map.match(queries, kHighAbove, 1000 * t, 1000 * (t + 1), matches); });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    ASSERT_EQ(matches[i].d, expected[i].d);
    ASSERT_EQ(matches[i].variance, expected[i].variance);
  }
}

TEST(KnnSurfaceMap, RemovalWaitsUntilTheCentreMoved)
{
  KnnSurfaceMapOptions options;
  options.min_spacing = 0;
  KnnSurfaceMap map(options);
  map.insert(worldPoints(randomCloud(6, 5000, 10.0F)), Vec3::Zero());
  map.removeOutside({0, 0, 0}, 5.0);
  const std::size_t kept = map.pointCount();
  EXPECT_LT(kept, 5000U);
  map.removeOutside({0.4, 0, 0}, 5.0);
  EXPECT_EQ(map.pointCount(), kept);
  map.removeOutside({0.6, 0, 0}, 5.0);
  EXPECT_LT(map.pointCount(), kept);
}

TEST(KnnSurfaceMap, HandsOutACopyOfItsPoints)
{
  KnnSurfaceMap map = surfacesOf(roomCloud(7, 5000));
  const auto points = map.toPointsMap();
  ASSERT_EQ(points->size(), map.pointCount());
  map.removeOutside({1000, 0, 0}, 1.0);
  EXPECT_EQ(map.pointCount(), 0U);
  EXPECT_GT(points->size(), 0U);
}

TEST(KnnSurfaceMap, RefusesSenselessOptionsAndRanges)
{
  const auto expectRefused = [](auto change)
  {
    KnnSurfaceMapOptions options;
    change(options);
    EXPECT_THROW(KnnSurfaceMap{options}, std::invalid_argument);
  };
  expectRefused([](auto& o) { o.min_spacing = -1; });
  expectRefused([](auto& o) { o.min_spacing = std::numeric_limits<double>::quiet_NaN(); });
  expectRefused([](auto& o) { o.point_noise = 0; });

  const KnnSurfaceMap map;
  std::vector<PlaneMatch> matches(2);
  const WorldPoints points = worldPoints(Cloud{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_THROW(map.match(points, kHighAbove, 0, 3, matches), std::invalid_argument);
  EXPECT_THROW(map.match(points, kHighAbove, 2, 1, matches), std::invalid_argument);
  EXPECT_NO_THROW(map.match(points, kHighAbove, 1, 1, matches));
}
