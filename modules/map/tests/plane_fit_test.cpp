// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/plane_fit.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace fastlio;
using Eigen::Vector3d;

namespace
{
using Points = std::vector<Vector3d>;

PointMoments moments(const Points& points)
{
  return momentsOf(points.data(), points.size());
}

Vector3d randomVector(std::mt19937& rng, double sigma)
{
  std::normal_distribution<double> n(0.0, sigma);
  return {n(rng), n(rng), n(rng)};
}

/** Points in a disc of radius 0.7 m about \a center with \a noise along the normal. */
Points disc(std::mt19937& rng, const Vector3d& center, const Vector3d& normal, double noise, int n)
{
  std::uniform_real_distribution<double> u(-0.7, 0.7);
  std::normal_distribution<double> e(0.0, noise);
  const Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  Points points;
  for (int i = 0; i < n; ++i)
    points.push_back(center + u(rng) * a + u(rng) * b + e(rng) * normal);
  return points;
}
}  // namespace

TEST(PlaneFit, RecoversAnExactPlaneFarFromTheOrigin)
{
  std::mt19937 rng(1);
  for (int trial = 0; trial < 500; ++trial)
  {
    const Vector3d normal = randomVector(rng, 1).normalized();
    const Vector3d center = randomVector(rng, 1000);
    const auto fit = fitPlane(moments(disc(rng, center, normal, 0.0, 5)), 1e-9);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(std::abs(fit->normal.dot(normal)), 1.0, 1e-9);
    EXPECT_NEAR(fit->distance(center), 0.0, 1e-7);
    EXPECT_NEAR(fit->eigenvalues[0], 0.0, 1e-12);
    EXPECT_EQ(fit->count, 5U);
  }
}

TEST(PlaneFit, AgreesWithTheIterativeEigenSolver)
{
  std::mt19937 rng(2);
  for (const double noise : {1e-6, 1e-4, 1e-2, 0.1, 0.5})
  {
    for (int trial = 0; trial < 300; ++trial)
    {
      const Vector3d normal = randomVector(rng, 1).normalized();
      const PointMoments m = moments(disc(rng, randomVector(rng, 50), normal, noise, 5));
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> exact(m.covariance);
      const Vector3d& values = exact.eigenvalues();
      const auto fit = fitPlane(m);
      ASSERT_EQ(bool(fit), values[1] > 1e-6 * values[2]);
      if (!fit) continue;
      EXPECT_TRUE(
          fit->eigenvalues.isApprox(values, 1e-9) || (fit->eigenvalues - values).norm() < 1e-14);
      const double gap = (values[1] - values[0]) / values[2];
      if (gap < 1e-3) continue;  // the normal itself is undetermined
      const double sine = fit->normal.cross(exact.eigenvectors().col(0)).norm();
      EXPECT_LT(sine, 1e-12 / gap) << "noise " << noise;
    }
  }
}

TEST(PlaneFit, MinimisesTheSumOfSquaredDistances)
{
  std::mt19937 rng(3);
  const Points points = disc(rng, {3, -2, 1}, Vector3d(1, 2, 3).normalized(), 0.05, 12);
  const auto fit = fitPlane(moments(points));
  ASSERT_TRUE(fit);
  const auto cost = [&](const Vector3d& normal, const Vector3d& through)
  {
    double sum = 0;
    for (const Vector3d& p : points)
      sum += std::pow(normal.dot(p - through), 2);
    return sum;
  };
  const double best = cost(fit->normal, fit->centroid);
  EXPECT_NEAR(best, 12 * fit->eigenvalues[0], 1e-12);
  for (int i = 0; i < 200; ++i)
  {
    const Vector3d n = (fit->normal + randomVector(rng, 0.01)).normalized();
    EXPECT_GE(cost(n, fit->centroid + randomVector(rng, 0.01)), best);
  }
}

TEST(PlaneFit, RefusesWhatMakesNoPlane)
{
  EXPECT_FALSE(fitPlane(moments({})));
  EXPECT_FALSE(fitPlane(moments({{1, 2, 3}, {2, 2, 3}})));
  EXPECT_FALSE(fitPlane(moments(Points(5, {1, 2, 3}))));
  EXPECT_FALSE(fitPlane(moments(Points(5, {1000.1, 2000.2, 3000.3}))));
  Points line;
  for (int i = 0; i < 5; ++i)
    line.push_back(Vector3d(10, 20, 30) + 0.3 * i * Vector3d(1, -2, 0.5));
  EXPECT_FALSE(fitPlane(moments(line)));
  line[2] = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(fitPlane(moments(line)));
  line[2] = Vector3d::Constant(std::numeric_limits<double>::infinity());
  EXPECT_FALSE(fitPlane(moments(line)));
}

TEST(PlaneFit, OffsetVarianceIsThatOfRepeatedFits)
{
  std::mt19937 rng(4);
  const double sigma = 0.01;
  const Vector3d normal = Vector3d(0.2, -0.3, 1).normalized(), a = normal.unitOrthogonal();
  const Points truth = disc(rng, Vector3d::Zero(), normal, 0.0, 6);
  for (const double away : {0.0, 0.5, 2.0})
  {
    const Vector3d at = away * a;
    double sum = 0, predicted = 0;
    constexpr int kTrials = 20000;
    std::normal_distribution<double> e(0, sigma);
    for (int trial = 0; trial < kTrials; ++trial)
    {
      Points noisy = truth;
      for (Vector3d& p : noisy)
        p += e(rng) * normal;
      const auto fit = fitPlane(moments(noisy));
      ASSERT_TRUE(fit);
      sum += std::pow(fit->distance(at), 2);  // the point lies on the true plane
      predicted += planeOffsetVariance(*fit, at, sigma * sigma);
    }
    EXPECT_NEAR(sum / predicted, 1.0, 0.06) << away << " m away";
  }
}

TEST(LineFit, RecoversAnExactLine)
{
  std::mt19937 rng(5);
  for (int trial = 0; trial < 200; ++trial)
  {
    const Vector3d direction = randomVector(rng, 1).normalized(), through = randomVector(rng, 100);
    Points points;
    for (int i = 0; i < 5; ++i)
      points.push_back(through + 0.4 * i * direction);
    const auto fit = fitLine(moments(points));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(std::abs(fit->direction.dot(direction)), 1.0, 1e-10);
    EXPECT_NEAR(fit->distance(through - 3 * direction), 0.0, 1e-6);
    const Vector3d off = direction.unitOrthogonal();
    EXPECT_NEAR(fit->distance(through + 2 * off), 2.0, 1e-6);
  }
}

TEST(LineFit, RefusesWhatMakesNoLine)
{
  std::mt19937 rng(6);
  EXPECT_FALSE(fitLine(moments({})));
  EXPECT_FALSE(fitLine(moments({{1, 2, 3}})));
  EXPECT_FALSE(fitLine(moments(Points(5, {1, 2, 3}))));
  // A square has no direction, two points have one.
  EXPECT_FALSE(fitLine(moments({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})));
  EXPECT_TRUE(fitLine(moments({{0, 0, 0}, {1, 2, 3}})));
}
