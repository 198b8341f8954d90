// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "zero_velocity.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
constexpr double kVelocityStd = 0.01, kRateStd = 1e-3;
const Vec3 kRate{0.004, -0.002, 0.001};

FilterState someState(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  StateMatrix A;
  for (int i = 0; i < kStateDim; ++i)
    for (int j = 0; j < kStateDim; ++j)
      A(i, j) = 2e-3 * normal(random);
  FilterState s;
  s.P = A * A.transpose();
  s.x.v = {0.004, -0.006, 0.002};
  s.x.gyro_bias = kRate + Vec3(1e-3, -1e-3, 5e-4);
  return s;
}
}  // namespace

TEST(ZeroVelocity, IsTheKalmanUpdateInInformationForm)
{
  const FilterState prior = someState(1);
  const auto update = zeroVelocityUpdate(prior, kRate, kVelocityStd, kRateStd);
  ASSERT_TRUE(update);
  Eigen::Matrix<double, 6, kStateDim> H = Eigen::Matrix<double, 6, kStateDim>::Zero();
  H.block<3, 3>(0, kVelocity).setIdentity();
  H.block<3, 3>(3, kGyroBias).setIdentity();
  Eigen::Matrix<double, 6, 1> weight;
  weight << Vec3::Constant(std::pow(kVelocityStd, -2)), Vec3::Constant(std::pow(kRateStd, -2));
  const Eigen::Matrix<double, kStateDim, kStateDim> P =
      (prior.P.inverse() + H.transpose() * weight.asDiagonal() * H).inverse();
  EXPECT_LT((update->posterior.P - P).norm(), 1e-6 * prior.P.norm());
  Eigen::Matrix<double, 6, 1> z;
  z << -prior.x.v, kRate - prior.x.gyro_bias;
  const StateVector dx = P * H.transpose() * weight.asDiagonal() * z;
  EXPECT_LT((boxminus(update->posterior.x, prior.x) - dx).norm(), 1e-6 * dx.norm());
}

TEST(ZeroVelocity, ReportsTheRestOfAnEarlierError)
{
  const FilterState prior = someState(2);
  const auto update = zeroVelocityUpdate(prior, kRate, kVelocityStd, kRateStd);
  ASSERT_TRUE(update);
  // With exact measurements, the error after is (I - K H) times the error before.
  NavState truth = prior.x;
  truth.v.setZero();
  truth.gyro_bias = kRate;
  const StateVector before = boxminus(truth, prior.x);
  const StateVector after = boxminus(truth, update->posterior.x);
  EXPECT_LT(
      (after - (before - update->gain * before.segment<6>(kVelocity))).norm(),
      1e-4 * before.norm());
}

TEST(ZeroVelocity, RepeatedItStopsThePlatform)
{
  FilterState s = someState(3);
  for (int i = 0; i < 1000; ++i)
  {
    const auto update = zeroVelocityUpdate(s, kRate, kVelocityStd, kRateStd);
    ASSERT_TRUE(update);
    s = update->posterior;
  }
  EXPECT_LT(s.x.v.norm(), 1e-4);
  EXPECT_LT((s.x.gyro_bias - kRate).norm(), 1e-4);
  EXPECT_LT((s.P - s.P.transpose()).norm(), 1e-15);
}

TEST(ZeroVelocity, IsRefusedByAStateThatMoves)
{
  FilterState s = someState(4);
  s.x.v = {1.0, 0.0, 0.0};
  EXPECT_FALSE(zeroVelocityUpdate(s, kRate, kVelocityStd, kRateStd));
  s = someState(4);
  s.x.gyro_bias.x() = 0.1;
  EXPECT_FALSE(zeroVelocityUpdate(s, kRate, kVelocityStd, kRateStd));
  s = someState(4);
  s.P(0, 0) = std::nan("");
  EXPECT_FALSE(zeroVelocityUpdate(s, kRate, kVelocityStd, kRateStd));
}

}  // namespace fastlio
