// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/posegraph/pose_graph.h>

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

/** A road around a square whose odometry pitches by the same every metre: it comes back to its
 * start as if nothing were wrong. Gravity shows it, through a bias of the accelerometer. */
TEST(PoseGraph, GravityShowsTheDriftThatALoopHides)
{
  constexpr std::size_t kSide = 20;
  constexpr double kStepLength = 5.0;
  const Vec3 up = expSO3({0.01, -0.006, 0.0}) * Vec3::UnitZ(), bias(0.008, -0.01, 0.0);
  Vector6 drift = Vector6::Zero();
  drift[1] = -5e-5;  // [rad/m]
  std::vector<Pose> truth(1);
  PoseGraph graph;
  graph.nodes.resize(1);
  // Errors of the sensor: its drift, then the bias.
  Eigen::VectorXd variances(9);
  variances << Vec3::Constant(1e-8), Vec3::Constant(1e-6), Vec3::Constant(4e-4);
  graph.sensor_covariances.emplace_back(variances.asDiagonal());
  Eigen::MatrixXd by_drift = Eigen::MatrixXd::Zero(6, 9), by_bias = Eigen::MatrixXd::Zero(3, 9);
  by_drift.leftCols<6>() = kStepLength * Matrix6::Identity();
  by_bias.rightCols<3>() = Mat3::Identity();
  const Matrix6 noise = 1e-8 * Matrix6::Identity();
  for (std::size_t i = 1; i <= 4 * kSide; ++i)
  {
    const double turn = i % kSide == 0 ? 1.5707963267948966 : 0.0;
    const Pose step{expSO3({0, 0, turn}), {kStepLength, 0, 0}};
    truth.push_back(truth.back() * step);
    const Vector6 excess = kStepLength * drift;
    const Pose measured{step.R * expSO3(excess.head<3>()), step.p + excess.tail<3>()};
    graph.nodes.push_back(graph.nodes.back() * measured);
    graph.edges.push_back({i - 1, i, {measured, noise}, false, 0, by_drift});
  }
  const Pose end = truth.front().inverse() * truth.back();
  EXPECT_LT((graph.nodes.back().p - truth.back().p).norm(), 0.3);
  EXPECT_GT(std::abs(graph.nodes[2 * kSide].p.z()), 0.4);
  graph.edges.push_back({0, 4 * kSide, {end, noise}, true});
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    TiltFactor tilt{i, Vec3::Zero(), 1e-7 * Mat3::Identity(), 0, by_bias};
    tilt.up = (truth[i].R.transpose() * up + bias).normalized();
    graph.tilts.push_back(tilt);
  }
  const GraphEstimate estimate = optimize(graph);
  EXPECT_TRUE(estimate.converged);
  const Eigen::VectorXd& found = estimate.sensor_errors[0];
  EXPECT_NEAR(found[1], drift[1], 0.1 * std::abs(drift[1]));
  const RelativePose step = withoutSensorErrors(graph.edges[0], estimate);
  EXPECT_LT(logSO3(step.T_a_b.R.transpose() * truth[1].R).norm(), 0.1 * kStepLength * 5e-5);
  EXPECT_NEAR(step.covariance(1, 1), 1e-8 + std::pow(0.1 * kStepLength * 5e-5, 2), 1e-9);
  EXPECT_GT(step.covariance(1, 1), 1e-8);
  EXPECT_LT((estimate.up - up).norm(), 3e-4);
  EXPECT_LT((found.tail<3>() - bias).head<2>().norm(), 3e-4);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT((estimate.nodes[i].p - truth[i].p).norm(), 0.04) << i;
}

TEST(PoseGraph, PositionsTellWhereTheWorldIs)
{
  Circle circle(4);
  const Pose T_earth_world = pose({0, 0, 0.8}, {100, 200, 30});
  const Vec3 lever(0.1, 0.2, 0.3);
  for (std::size_t i = 0; i < Circle::kNodes; i += 2)
    circle.graph.positions.push_back(
        {i, lever, T_earth_world * (circle.truth[i] * lever), 0.01 * Mat3::Identity()});
  circle.graph.positions[7].position += Vec3(12.0, -9.0, 3.0);
  circle.graph.T_earth_world = pose({0, 0, 0.7}, {99, 201, 30});
  const GraphEstimate estimate = optimize(circle.graph);
  EXPECT_EQ(estimate.position_weights[7], 0.0);
  EXPECT_EQ(estimate.position_weights[8], 1.0);
  ASSERT_TRUE(estimate.T_earth_world);
  for (std::size_t i = 0; i < Circle::kNodes; ++i)
  {
    const Vec3 found = *estimate.T_earth_world * estimate.nodes[i].p;
    EXPECT_LT((found - T_earth_world * circle.truth[i].p).norm(), 0.25);
  }
}

TEST(PoseGraph, HeightsOfPositionsThatErrDoNotTiltTheEarth)
{
  const Mat3 errors = Mat3::Identity() + 3e-3 * Vec3::UnitZ() * Vec3::UnitX().transpose();
  Circle circle(4);
  circle.graph.T_earth_world.emplace();
  for (std::size_t i = 0; i < Circle::kNodes; ++i)
    circle.graph.positions.push_back({i, {0, 0, 0}, errors * circle.truth[i].p, Mat3::Identity()});
  const GraphEstimate found = optimize(circle.graph);
  ASSERT_TRUE(found.T_earth_world);
  EXPECT_LT((found.T_earth_world->R * found.up).head<2>().norm(), 3e-4);
}

TEST(PoseGraph, RefusesWhatIsNoGraph)
{
  Circle circle(5);
  const RelativePose measured{{}, Matrix6::Identity()};
  circle.graph.edges.push_back({0, Circle::kNodes, measured, false});
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
  circle.graph.edges.back() = {0, 1, {{}, Matrix6::Zero()}, false};
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
  circle.graph.edges.pop_back();
  circle.graph.edges.push_back({0, 1, measured, false, 0, Eigen::MatrixXd::Zero(6, 2)});
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);  // of a sensor that is none
  circle.graph.sensor_covariances.emplace_back(Eigen::MatrixXd::Identity(3, 3));
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);  // it has three errors
  circle.graph.sensor_covariances.clear();
  circle.graph.edges.pop_back();
  circle.graph.tilts.push_back({});
  circle.graph.tilts.back().node = Circle::kNodes;
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
  circle.graph.tilts.pop_back();
  circle.graph.positions.push_back({});
  EXPECT_THROW((void)optimize(circle.graph), std::invalid_argument);
}

TEST(PoseGraph, OfNothingIsNothing)
{
  EXPECT_TRUE(optimize({}).nodes.empty());
}

}  // namespace fastlio
