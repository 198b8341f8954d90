// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "failure_message.h"
#include <fastlio/earth/earth_fit.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace fastlio
{
namespace
{
Pose yawPose(double yaw, const Vec3& p)
{
  Pose pose;
  pose.R << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0, 0, 1;
  pose.p = p;
  return pose;
}

double yawOf(const Pose& pose)
{
  return std::atan2(pose.R(1, 0), pose.R(0, 0));
}

const Pose kTruth = yawPose(2.1, {350, -80, 12});

/** Points of a map of 200 m, far from its origin, seen with noise. */
class Points
{
 public:
  explicit Points(std::uint64_t seed) : random_(seed) {}

  std::vector<Correspondence> make(std::size_t count, double std_m)
  {
    std::vector<Correspondence> points;
    for (std::size_t i = 0; i < count; ++i)
    {
      Correspondence point;
      point.map = Vec3(500, 300, 0) + Vec3(uniform(100), uniform(100), uniform(5));
      point.std_m = std_m * (1.0 + 0.5 * uniform(1));
      point.enu = kTruth * point.map + point.std_m * noise();
      point.name = "P" + std::to_string(i);
      points.push_back(point);
    }
    return points;
  }
  double uniform(double range)
  {
    return std::uniform_real_distribution<double>(-range, range)(random_);
  }
  Vec3 noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

std::string refusalOfFit(
    const std::vector<Correspondence>& points, const EarthFitOptions& options = {})
{
  return testing::failureOf([&] { (void)fitToEarth(points, options); });
}

double squaredSum(const std::vector<Correspondence>& points, const Pose& pose)
{
  double sum = 0;
  for (const Correspondence& point : points)
    sum += (pose * point.map - point.enu).squaredNorm() / (point.std_m * point.std_m);
  return sum;
}

TEST(EarthFit, ExactPointsGiveTheExactPose)
{
  Points source(1);
  auto points = source.make(5, 0.05);
  for (Correspondence& point : points)
    point.enu = kTruth * point.map;
  const EarthFit fit = fitToEarth(points);
  EXPECT_LT((fit.T_enu_map.R - kTruth.R).norm(), 1e-12);
  EXPECT_LT((fit.T_enu_map.p - kTruth.p).norm(), 1e-9);
  EXPECT_LT(fit.rms_m, 1e-9);
  EXPECT_EQ(fit.used(), 5U);
}

TEST(EarthFit, NoOtherPoseHasASmallerSumOfSquares)
{
  Points source(2);
  const auto points = source.make(7, 0.3);
  const EarthFit fit = fitToEarth(points);
  ASSERT_EQ(fit.used(), 7U);
  const double least = squaredSum(points, fit.T_enu_map), yaw = yawOf(fit.T_enu_map);
  for (const double step : {1e-4, -1e-4})
  {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_GT(squaredSum(points, yawPose(yaw, fit.T_enu_map.p + step * Vec3::Unit(axis))), least);
    // About the middle of the map.
    const Vec3 middle(500, 300, 0);
    const Pose turned = yawPose(yaw + step, Vec3::Zero());
    EXPECT_GT(squaredSum(points, {turned.R, fit.T_enu_map * middle - turned.R * middle}), least);
  }
}

TEST(EarthFit, AnUncertainPointCountsLess)
{
  Points source(4);
  auto points = source.make(4, 0.01);
  points[2].enu += Vec3(0.5, 0, 0);
  points[2].std_m = 1.0;
  const EarthFit fit = fitToEarth(points);
  EXPECT_LT((fit.T_enu_map * Vec3(500, 300, 0) - kTruth * Vec3(500, 300, 0)).norm(), 0.03);
  EXPECT_EQ(fit.used(), 4U);
}

TEST(EarthFit, OnePointOfManyIsFoundAndNamed)
{
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    Points source(seed);
    auto points = source.make(4 + seed % 9, 0.05);
    const std::size_t wrong = seed % points.size();
    points[wrong].enu += 20.0 * source.noise().normalized();
    const EarthFit fit = fitToEarth(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (i == wrong)
      {
        EXPECT_FALSE(fit.residuals[i].is_used) << seed;
        EXPECT_NEAR(fit.residuals[i].residual_m.norm(), 20.0, 2.0) << seed;
        EXPECT_EQ(fit.residuals[i].name, points[wrong].name);
      }
    EXPECT_GE(fit.used() + 2, points.size()) << seed;
    EXPECT_LT((fit.T_enu_map * Vec3(500, 300, 0) - kTruth * Vec3(500, 300, 0)).norm(), 0.3);
  }
}

TEST(EarthFit, ThreeOfTenAndManyOfHundredsAreFound)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const auto& [count, wrong] : {std::pair<std::size_t, std::size_t>{10, 3}, {300, 120}})
    {
      Points source(seed);
      auto points = source.make(count, 0.05);
      for (std::size_t i = 0; i < wrong; ++i)
        points[i].enu += 20.0 * source.noise().normalized();
      const EarthFit fit = fitToEarth(points);
      // One good point in a thousand is beyond the gate.
      EXPECT_GE(fit.used() + 1 + count / 100, count - wrong) << seed << " " << count;
      for (std::size_t i = 0; i < wrong; ++i)
        EXPECT_FALSE(fit.residuals[i].is_used) << seed << " " << count;
      EXPECT_LT((fit.T_enu_map * Vec3(500, 300, 0) - kTruth * Vec3(500, 300, 0)).norm(), 0.2);
    }
}

TEST(EarthFit, DriftOfTheMapIsAllowedFor)
{
  Points source(6);
  auto points = source.make(10, 0.01);
  for (Correspondence& point : points)
    point.map += 0.3 * source.noise();
  EXPECT_NE(refusalOfFit(points).find("control points contradict each other"), std::string::npos);
  EarthFitOptions options;
  options.map_std_m = 0.3;
  const EarthFit fit = fitToEarth(points, options);
  EXPECT_EQ(fit.used(), 10U);
}

TEST(EarthFit, TheHeadingMustBeSeen)
{
  Points source(7);
  auto points = source.make(3, 0.05);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].std_m = 0.05;
    points[i].map = Vec3(500 + 0.4 * static_cast<double>(i), 300, 0);
    points[i].enu = kTruth * points[i].map;
  }
  EXPECT_EQ(
      refusalOfFit(points),
      "control points do not show the heading of the map: the 3 in use lie within 0.33 m of their "
      "centre (rms, horizontal), which leaves a standard deviation of 5.1 deg, more than 2; give "
      "points that lie further apart");
  // A mast: only heights differ.
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].map = Vec3(500, 300, 10.0 * static_cast<double>(i));
    points[i].enu = kTruth * points[i].map;
  }
  EXPECT_EQ(
      refusalOfFit(points),
      "control points do not show the heading of the map: the 3 in use lie within 0.00 m of their "
      "centre (rms, horizontal); give points that lie further apart");
}

TEST(EarthFit, ContradictionsAreRefused)
{
  Points source(8);
  auto points = source.make(6, 0.05);
  for (Correspondence& point : points)
    point.enu = 100 * source.noise();
  const std::string text = refusalOfFit(points);
  EXPECT_EQ(text.find("control points contradict each other: no more than "), 0U) << text;
  auto two = source.make(2, 0.05);
  two[0].enu += Vec3(0, 0, 20);
  EXPECT_EQ(refusalOfFit(two).find("control points contradict each other: no more than "), 0U)
      << refusalOfFit(two);
  two[0].map = {0, 0, 0};
  two[1].map = {30, 40, 0};
  two[0].enu = {0, 0, 0};
  two[1].enu = {0, 62.5, 0};
  EXPECT_NE(
      refusalOfFit(two).find(
          "; from 'P0' to 'P1' it is 50.00 m in the map and 62.50 m on the earth; "),
      std::string::npos)
      << refusalOfFit(two);
}

TEST(EarthFit, BadInputIsNamed)
{
  Points source(9);
  EXPECT_EQ(
      refusalOfFit({}),
      "control points: 0; give at least two, far apart, for the heading of the map");
  EXPECT_NE(refusalOfFit(source.make(1, 0.05)).find("control points: 1;"), std::string::npos);
  auto points = source.make(3, 0.05);
  points[1].std_m = 0;
  EXPECT_EQ(
      refusalOfFit(points),
      "control point 'P1': coordinates are not finite, or its standard deviation is not above 0 m");
  points[1].std_m = 0.1;
  points[2].name.clear();
  points[2].enu.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusalOfFit(points).find("control point number 3: "), 0U);
  EarthFitOptions options;
  options.map_std_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusalOfFit(source.make(3, 0.05), options), "");
}
}  // namespace
}  // namespace fastlio
