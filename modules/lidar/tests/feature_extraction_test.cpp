// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file feature_extraction_test.cpp Which points become planar and edge features. */

#include "feature_scans.h"
#include <fastlio/lidar/feature_extraction.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace fastlio::testing
{
namespace
{
ScanFeatures featuresOf(const PointColumns& points, const FeatureLimits& limits = {})
{
  FeatureExtractor extractor;
  ScanFeatures features;
  extractor.extract(points, limits, features);
  return features;
}

/** A wall whose normal is met at the azimuth 0, and nothing else. */
RangeOf wallRange(double distance, double sideways)
{
  return [=](const Vec3& u)
  { return u.x() > 0.0 && std::abs(u.y() / u.x()) < sideways ? distance / u.x() : 0.0; };
}

/** A board of the given half width before a wall. */
RangeOf boardBeforeWall(double board, double wall, double half_width)
{
  return [=](const Vec3& u)
  {
    if (u.x() < 0.5) return 0.0;
    return std::abs(board * u.y() / u.x()) < half_width ? board / u.x() : wall / u.x();
  };
}

TEST(FeatureExtraction, CornersGiveEdgesAndWallsPlanarPoints)
{
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> size(2.0, 12.0), yaw(-M_PI, M_PI);
  for (int trial = 0; trial < 30; ++trial)
  {
    const double half_x = size(rng),
                 half_y = half_x * std::uniform_real_distribution<double>(0.6, 1.6)(rng);
    const double turned = yaw(rng);
    const PointColumns points = spin(roomRange(half_x, half_y, turned));
    const ScanFeatures features = featuresOf(points);
    // 8 rings, 4 corners; one of them may lie where the revolution starts and ends.
    EXPECT_GE(features.edges.size(), 24U);
    EXPECT_LE(features.edges.size(), 32U);
    for (const std::uint32_t i : features.edges)
      EXPECT_LT(distanceToCorner(half_x, half_y, turned, pointAt(points, i)), 0.1);
    EXPECT_GT(features.planar.size(), points.size() / 2);
    for (const std::uint32_t i : features.planar)
      EXPECT_GT(distanceToCorner(half_x, half_y, turned, pointAt(points, i)), 0.15);
  }
}

TEST(FeatureExtraction, RangeNoiseNeitherMakesEdgesNorHidesThem)
{
  Spin sensor;
  sensor.noise = 0.02;
  std::size_t edges = 0, planar = 0, total = 0;
  constexpr int kTrials = 20;
  for (unsigned trial = 0; trial < kTrials; ++trial)
  {
    const double yaw = 0.3 + 0.02 * trial;
    const PointColumns points = spin(roomRange(4, 5, yaw), sensor, trial);
    const ScanFeatures features = featuresOf(points);
    for (const std::uint32_t i : features.edges)
      EXPECT_LT(distanceToCorner(4, 5, yaw, pointAt(points, i)), 0.25);
    edges += features.edges.size();
    planar += features.planar.size();
    total += points.size();
  }
  EXPECT_GE(edges, 31U * kTrials);
  EXPECT_LE(edges, 33U * kTrials);
  EXPECT_GT(planar, total * 7 / 10);
}

TEST(FeatureExtraction, BordersOfOcclusionGiveNothing)
{
  // A board of 2 m, 3 m away, before a wall at 6 m: real points, but a shadow that moves.
  const PointColumns points = spin(boardBeforeWall(3.0, 6.0, 1.0));
  const ScanFeatures features = featuresOf(points);
  EXPECT_TRUE(features.edges.empty());
  EXPECT_FALSE(features.planar.empty());
  const double border = std::atan2(1.0, 3.0);
  bool before = false, behind = false;
  for (const std::uint32_t i : features.planar)
  {
    const double x = points.x[i];
    const double to_border = std::abs(std::abs(azimuthAt(points, i)) - border) * x;
    EXPECT_GT(to_border, 0.3) << "at x = " << x;
    (x < 4.0 ? before : behind) = true;
  }
  EXPECT_TRUE(before);
  EXPECT_TRUE(behind);
}

TEST(FeatureExtraction, SmallStepsAreNoEdgesEither)
{
  // Wherever the scan line is not cut, the shape itself must not look like a corner that is met
  // well from both sides.
  for (const double depth : {0.15, 0.3, 0.6, 1.0})
    for (const double distance : {2.0, 4.0, 8.0})
      EXPECT_TRUE(featuresOf(spin(boardBeforeWall(distance, distance + depth, 0.25 * distance)))
                      .edges.empty())
          << depth << " m at " << distance << " m";
}

TEST(FeatureExtraction, GrazedSurfacesGiveNothing)
{
  FeatureLimits limits;
  const PointColumns points = spin(wallRange(1.0, 20.0));
  const ScanFeatures features = featuresOf(points, limits);
  ASSERT_FALSE(features.planar.empty());
  EXPECT_TRUE(features.edges.empty());
  double least = 10.0;
  for (const std::uint32_t i : features.planar)
  {
    const Vec3 p = pointAt(points, i);
    least = std::min(least, std::atan2(1.0, std::abs(p.y())));  // angle to the wall, level ring
  }
  EXPECT_GT(least, 0.9 * limits.min_incidence);
  EXPECT_LT(least, 1.3 * limits.min_incidence);
  limits.min_incidence = 0.8;
  for (const std::uint32_t i : featuresOf(points, limits).planar)
    EXPECT_LT(std::abs(points.y[i]), 1.3);
}

TEST(FeatureExtraction, IsolatedPointsGiveNothing)
{
  // A fence: bars of a few points with nothing behind.
  const RangeOf fence = [](const Vec3& u)
  { return std::fmod(std::atan2(u.y(), u.x()) + 2 * M_PI, 0.2) < 0.03 ? 5.0 : 0.0; };
  const PointColumns points = spin(fence);
  ASSERT_GT(points.size(), 1000U);
  const ScanFeatures features = featuresOf(points);
  EXPECT_TRUE(features.planar.empty());
  EXPECT_TRUE(features.edges.empty());
}

TEST(FeatureExtraction, BlindRangeAndInvalidPointsAreLeftOutAndCounted)
{
  PointColumns points = spin(wallRange(5.0, 1.0));
  const ScanFeatures clean = featuresOf(points);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  points.push_back(nan, 1, 1, 0, 0, 3);
  points.push_back(0, 0, 0, 0, 0, 3);
  points.push_back(infinite, 0, 0, 0, 0, 3);
  points.push_back(0.1F, 0, 0, 0, 0, 3);
  points.push_back(1e3F, 0, 0, 0, 0, 3);
  const ScanFeatures features = featuresOf(points);
  EXPECT_EQ(features.planar, clean.planar);
  EXPECT_EQ(features.dropped_invalid, 3U);
  EXPECT_EQ(features.dropped_near, 1U);
  EXPECT_EQ(features.dropped_far, 1U);

  FeatureLimits far_sighted;
  far_sighted.min_range = 5.5F;
  for (const std::uint32_t i : featuresOf(points, far_sighted).planar)
    EXPECT_GE(pointAt(points, i).norm(), 5.5);
}

TEST(FeatureExtraction, DoesNotDependOnTheOrderOfThePoints)
{
  Spin sensor;
  sensor.noise = 0.02;
  const PointColumns points = spin(roomRange(4, 5, 0.4), sensor);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937 rng(5);
  std::shuffle(order.begin(), order.end(), rng);
  const ScanFeatures expected = featuresOf(points);
  const ScanFeatures shuffled = featuresOf(permuted(points, order));
  const auto inOriginal = [&](std::vector<std::uint32_t> indices)
  {
    for (std::uint32_t& i : indices)
      i = order[i];
    std::sort(indices.begin(), indices.end());
    return indices;
  };
  EXPECT_EQ(inOriginal(shuffled.planar), expected.planar);
  EXPECT_EQ(inOriginal(shuffled.edges), expected.edges);
}

TEST(FeatureExtraction, FindsTheSameWithoutRings)
{
  Spin sensor;
  const ScanFeatures expected = featuresOf(spin(roomRange(4, 5, 0.4), sensor));
  sensor.with_rings = false;
  const ScanFeatures features = featuresOf(spin(roomRange(4, 5, 0.4), sensor));
  EXPECT_EQ(features.line_order, ScanLineOrder::Elevation);
  EXPECT_EQ(features.planar, expected.planar);
  EXPECT_EQ(features.edges, expected.edges);
}

/** A single beam that wanders over the front quarter: two prisms, as in a non-repetitive sensor. */
PointColumns rosette(const RangeOf& range_of)
{
  PointColumns points;
  for (int k = 0; k < 20000; ++k)
  {
    const double t = k / 40e3;
    const double left = 0.3 * (std::cos(180 * t) + std::cos(-107 * t));
    const double up = 0.3 * (std::sin(180 * t) + std::sin(-107 * t));
    const Vec3 u = Vec3(1.0, left, up).normalized();
    const Vec3 p = range_of(u) * u;
    points.push_back(float(p.x()), float(p.y()), float(p.z()), 0.0F, k * 25000, 0);
  }
  return points;
}

TEST(FeatureExtraction, WorksAlongTheLineOfANonRepetitiveSensor)
{
  // Two walls that meet in a vertical edge at (5, 0), seen from inside.
  const RangeOf wedge = [](const Vec3& u) { return 5.0 / (u.x() + std::abs(u.y())); };
  const PointColumns points = rosette(wedge);
  const ScanFeatures features = featuresOf(points);
  EXPECT_EQ(features.line_order, ScanLineOrder::Time);
  // Where the beam turns there are none.
  EXPECT_GT(features.edges.size(), 10U);
  EXPECT_GT(features.planar.size(), points.size() / 3);
  for (const std::uint32_t i : features.edges)
    EXPECT_LT(std::hypot(points.x[i] - 5.0, points.y[i]), 0.15);
  // Flat surroundings give none, however the beam turns.
  const RangeOf wall = [](const Vec3& u) { return 5.0 / u.x(); };
  EXPECT_TRUE(featuresOf(rosette(wall)).edges.empty());
}

TEST(FeatureExtraction, TurnsWithTheScene)
{
  const PointColumns points = spin(roomRange(3, 5, 0.2));
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(0.9F, Eigen::Vector3f(1, -2, 0.5F).normalized()).toRotationMatrix();
  PointColumns turned = points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f p = R * Eigen::Vector3f(points.x[i], points.y[i], points.z[i]);
    turned.x[i] = p.x(), turned.y[i] = p.y(), turned.z[i] = p.z();
  }
  const ScanFeatures expected = featuresOf(points), features = featuresOf(turned);
  // Rounding may move a point across a threshold, no more.
  EXPECT_NEAR(double(features.planar.size()), double(expected.planar.size()), 3.0);
  EXPECT_EQ(features.edges.size(), expected.edges.size());
}

TEST(FeatureExtraction, TakesScansOfAnyKind)
{
  std::mt19937 rng(6);
  std::uniform_real_distribution<float> box(-30.0F, 30.0F);
  std::uniform_int_distribution<int> ring(0, 20), count(0, 400);
  FeatureExtractor extractor;
  ScanFeatures features;
  for (int trial = 0; trial < 200; ++trial)
  {
    PointColumns points;
    const int n = count(rng);
    for (int k = 0; k < n; ++k)
    {
      const bool repeated = k % 5 == 0 && k > 0;  // the same point again
      points.push_back(
          repeated ? points.x.back() : box(rng), repeated ? points.y.back() : box(rng),
          repeated ? points.z.back() : box(rng), 0.0F, k, static_cast<std::uint16_t>(ring(rng)));
    }
    extractor.extract(points, {}, features);
    std::vector<std::uint32_t> all = features.planar;
    all.insert(all.end(), features.edges.begin(), features.edges.end());
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
    for (const std::uint32_t i : all)
      EXPECT_LT(i, points.size());
  }
}
}  // namespace
}  // namespace fastlio::testing
