// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "../src/graph_factors.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
Pose pose(const Vec3& turn, const Vec3& p)
{
  return {expSO3(turn), p};
}

Pose moved(const Pose& x, int coordinate, double step)
{
  Vector6 d = Vector6::Zero();
  d[coordinate] = step;
  return {x.R * expSO3(d.head<3>()), x.p + d.tail<3>()};
}

const Pose kA = pose({0.3, -0.2, 1.1}, {4.0, -2.0, 1.0});
const Pose kB = pose({-0.4, 0.1, 2.0}, {9.0, 3.0, 0.5});
const RelativePose kMeasured{pose({-0.5, 0.4, 0.7}, {5.1, 4.4, -0.8}), Matrix6::Identity()};
constexpr double kStep = 1e-6;

/** A chain around a circle, whose odometry drifts. */
struct Circle
{
  static constexpr std::size_t kNodes = 40;
  std::vector<Pose> truth;
  PoseGraph graph;

  explicit Circle(unsigned seed, double turn_std = 0.004, double way_std = 0.03)
  {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < kNodes; ++i)
    {
      const double angle = 2.0 * 3.14159265358979 * static_cast<double>(i) / kNodes;
      truth.push_back(
          pose({0, 0, angle}, {20.0 * std::sin(angle), 20.0 - 20.0 * std::cos(angle), 0.0}));
    }
    graph.nodes.push_back(truth.front());
    Matrix6 covariance = Matrix6::Zero();
    covariance.diagonal().head<3>().setConstant(turn_std * turn_std);
    covariance.diagonal().tail<3>().setConstant(way_std * way_std);
    for (std::size_t i = 1; i < kNodes; ++i)
    {
      Pose motion = truth[i - 1].inverse() * truth[i];
      Vec3 turn, way;
      for (int axis = 0; axis < 3; ++axis)
      {
        turn[axis] = turn_std * normal(engine);
        way[axis] = way_std * normal(engine);
      }
      motion.p += way;
      motion.R = motion.R * expSO3(turn);
      graph.edges.push_back({i - 1, i, {motion, covariance}, false});
      graph.nodes.push_back(graph.nodes.back() * motion);
    }
  }

  void close(std::size_t a, std::size_t b, const Vec3& wrong = Vec3::Zero())
  {
    Pose motion = truth[a].inverse() * truth[b];
    motion.p += wrong;
    graph.edges.push_back({a, b, {motion, 1e-4 * Matrix6::Identity()}, true});
  }
};
}  // namespace

TEST(PoseGraphFactors, EdgeJacobiansAreTheNumericOnes)
{
  const EdgeError error = errorOf(kMeasured, kA, kB);
  for (int k = 0; k < 6; ++k)
  {
    const Vector6 by_a = (errorOf(kMeasured, moved(kA, k, kStep), kB).value - error.value) / kStep;
    const Vector6 by_b = (errorOf(kMeasured, kA, moved(kB, k, kStep)).value - error.value) / kStep;
    EXPECT_LT((by_a - error.by_a.col(k)).norm(), 1e-4) << k;
    EXPECT_LT((by_b - error.by_b.col(k)).norm(), 1e-4) << k;
  }
}

TEST(PoseGraphFactors, TiltJacobianIsTheNumericOne)
{
  const TiltFactor factor{0, expSO3({0.28, -0.18, 0.5}), Eigen::Matrix2d::Identity()};
  const TiltError error = errorOf(factor, kA);
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector2d numeric =
        (errorOf(factor, moved(kA, k, kStep)).value - error.value) / kStep;
    EXPECT_LT((numeric - error.by_attitude.col(k)).norm(), 1e-5) << k;
  }
}

TEST(PoseGraphFactors, TiltDoesNotSeeTheHeading)
{
  const TiltFactor factor{0, kA.R, Eigen::Matrix2d::Identity()};
  EXPECT_LT(errorOf(factor, {expSO3({0, 0, 2.0}) * kA.R, kA.p}).value.norm(), 1e-12);
  const Eigen::Vector2d tilt = errorOf(factor, {expSO3({1e-3, -2e-3, 0}) * kA.R, kA.p}).value;
  EXPECT_NEAR(tilt.x(), 1e-3, 1e-6);
  EXPECT_NEAR(tilt.y(), -2e-3, 1e-6);
}

TEST(PoseGraphFactors, PositionJacobiansAreTheNumericOnes)
{
  const PositionFactor factor{0, {0.5, -0.3, 1.2}, {10, 20, 3}, Mat3::Identity()};
  const PositionError error = errorOf(factor, kA, kB);
  for (int k = 0; k < 6; ++k)
  {
    const Vec3 by_node = (errorOf(factor, moved(kA, k, kStep), kB).value - error.value) / kStep;
    const Vec3 by_earth = (errorOf(factor, kA, moved(kB, k, kStep)).value - error.value) / kStep;
    EXPECT_LT((by_node - error.by_node.col(k)).norm(), 1e-4) << k;
    EXPECT_LT((by_earth - error.by_earth.col(k)).norm(), 1e-4) << k;
  }
}

TEST(PoseGraph, WithoutAClosureStaysAsItIs)
{
  const Circle circle(1);
  const GraphEstimate estimate = optimize(circle.graph);
  EXPECT_TRUE(estimate.converged);
  for (std::size_t i = 0; i < Circle::kNodes; ++i)
    EXPECT_LT((estimate.nodes[i].p - circle.graph.nodes[i].p).norm(), 1e-8);
}

TEST(PoseGraph, AClosureBringsTheChainTogether)
{
  Circle circle(2);
  const double before = (circle.graph.nodes.back().p - circle.truth.back().p).norm();
  circle.close(0, Circle::kNodes - 1);
  const GraphEstimate estimate = optimize(circle.graph);
  ASSERT_GT(before, 0.1);
  EXPECT_LT((estimate.nodes.back().p - circle.truth.back().p).norm(), 0.05);
  EXPECT_EQ(estimate.edge_weights.back(), 1.0);
}

TEST(PoseGraph, WrongClosuresAreTurnedOff)
{
  Circle circle(3);
  circle.close(0, Circle::kNodes - 1);
  circle.close(1, Circle::kNodes - 2);
  circle.close(2, 20, {4.0, -3.0, 0.0});
  circle.close(5, 30, {0.0, 6.0, 1.0});
  const GraphEstimate estimate = optimize(circle.graph);
  const std::vector<double> weights(estimate.edge_weights.end() - 4, estimate.edge_weights.end());
  EXPECT_EQ(weights, (std::vector<double>{1.0, 1.0, 0.0, 0.0}));
  for (std::size_t i = 0; i < Circle::kNodes; ++i)
    EXPECT_LT((estimate.nodes[i].p - circle.truth[i].p).norm(), 0.6) << i;
}

/** Over many chains the errors are as large as the covariance says. */
TEST(PoseGraph, CovarianceIsThatOfTheErrors)
{
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 10; seed < 60; ++seed)
  {
    Circle circle(seed);
    circle.close(0, Circle::kNodes - 1);
    circle.graph.edges.back().measured.covariance = 1e-8 * Matrix6::Identity();
    const GraphEstimate estimate = optimize(circle.graph);
    for (const std::size_t i : {10U, 20U, 30U})
    {
      const Pose& x = estimate.nodes[i];
      Eigen::Matrix<double, 6, 1> e;
      e << logSO3(x.R.transpose() * circle.truth[i].R), circle.truth[i].p - x.p;
      const Eigen::Matrix<double, 6, 6> P = estimate.covariances[i];
      sum += e.dot(P.inverse() * e);
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 6.0, 1.2);  // 150 samples, three in a chain hang together
}

TEST(PoseGraph, PositionsTellWhereTheWorldIs)
{
  Circle circle(4);
  const Pose T_earth_world = pose({0, 0, 0.8}, {100, 200, 30});
  for (std::size_t i = 0; i < Circle::kNodes; i += 2)
    circle.graph.positions.push_back(
        {i,
         {0.1, 0.2, 0.3},
         T_earth_world * (circle.truth[i] * Vec3(0.1, 0.2, 0.3)),
         0.01 * Mat3::Identity()});
  circle.graph.positions[7].position += Vec3(12.0, -9.0, 3.0);
  circle.graph.T_earth_world = pose({0, 0, 0.7}, {99, 201, 30});
  const GraphEstimate estimate = optimize(circle.graph);
  EXPECT_EQ(estimate.position_weights[7], 0.0);
  EXPECT_EQ(estimate.position_weights[8], 1.0);
  ASSERT_TRUE(estimate.T_earth_world);
  for (std::size_t i = 0; i < Circle::kNodes; ++i)
    EXPECT_LT(
        (*estimate.T_earth_world * estimate.nodes[i].p - T_earth_world * circle.truth[i].p).norm(),
        0.25);
}

TEST(PoseGraph, RefusesWhatIsNoGraph)
{
  Circle circle(5);
  circle.graph.edges.push_back({0, Circle::kNodes, kMeasured, false});
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
  circle.graph.edges.back() = {0, 1, {kMeasured.T_a_b, Matrix6::Zero()}, false};
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
  circle.graph.edges.pop_back();
  circle.graph.positions.push_back({});
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
}

TEST(PoseGraph, OfNothingIsNothing)
{
  EXPECT_TRUE(optimize({}).nodes.empty());
}

}  // namespace fastlio
