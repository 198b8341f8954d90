// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/posegraph/graph_factors.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
Pose moved(const Pose& x, int coordinate, double step)
{
  Vector6 d = Vector6::Zero();
  d[coordinate] = step;
  return {x.R * expSO3(d.head<3>()), x.p + d.tail<3>()};
}

const Pose kA{expSO3({0.3, -0.2, 1.1}), {4.0, -2.0, 1.0}};
const Pose kB{expSO3({-0.4, 0.1, 2.0}), {9.0, 3.0, 0.5}};
const RelativePose kMeasured{{expSO3({-0.5, 0.4, 0.7}), {5.1, 4.4, -0.8}}, Matrix6::Identity()};
constexpr double kStep = 1e-6;
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

TEST(PoseGraphFactors, TiltJacobiansAreTheNumericOnes)
{
  const Vec3 up = Vec3(0.02, -0.03, 1.0).normalized();
  TiltFactor factor;
  factor.up = kA.R.transpose() * Vec3(0.05, 0.01, 1.0).normalized();
  factor.by_sensor = Eigen::MatrixXd::Zero(3, 4);
  const Mat3 by_bias = expSO3({0.1, 0.2, 0.3});
  factor.by_sensor.rightCols<3>() = by_bias;
  const TiltError error = errorOf(factor, kA, up);
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector2d by_attitude =
        (errorOf(factor, moved(kA, k, kStep), up).value - error.value) / kStep;
    EXPECT_LT((by_attitude - error.by_attitude.col(k)).norm(), 1e-5) << k;
  }
  ASSERT_EQ(error.by_sensor.cols(), 4);
  EXPECT_EQ(error.by_sensor.col(0).norm(), 0.0);
  EXPECT_LT(
      (error.by_sensor.rightCols<3>() - acrossOf(factor.up).transpose() * by_bias).norm(), 1e-12);
  for (int k = 0; k < 2; ++k)
  {
    const Vec3 turned = (up + kStep * acrossOf(up).col(k)).normalized();
    const Eigen::Vector2d by_up = (errorOf(factor, kA, turned).value - error.value) / kStep;
    EXPECT_LT((by_up - error.by_up.col(k)).norm(), 1e-5) << k;
  }
}

TEST(PoseGraphFactors, TiltDoesNotSeeTheHeading)
{
  TiltFactor factor;
  factor.up = kA.R.transpose() * Vec3::UnitZ();
  const Pose turned{expSO3({0, 0, 2.0}) * kA.R, kA.p};
  const Pose tilted{expSO3({1e-3, -2e-3, 0}) * kA.R, kA.p};
  EXPECT_LT(errorOf(factor, turned, Vec3::UnitZ()).value.norm(), 1e-12);
  EXPECT_NEAR(errorOf(factor, tilted, Vec3::UnitZ()).value.norm(), 2.236e-3, 1e-6);
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

}  // namespace fastlio
