// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "measurement_problems.h"
#include <fastlio/filter/update.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
namespace
{
using testing::Random;

/** An iterate that is (not) the prior's mean. */
NavState iterateNear(Random& random, const FilterState& prior, double distance)
{
  StateVector dx = random.stateVector(distance);
  return boxplus(prior.x, dx);
}

/** Largest difference of two steps, relative to the sizes of what they hold. */
double difference(const UpdateStep& a, const UpdateStep& b)
{
  return std::max(
      (a.dx - b.dx).norm() / (1e-6 + a.dx.norm()), (a.P - b.P).norm() / (1e-12 + a.P.norm()));
}

void expectCovariance(const StateMatrix& P)
{
  EXPECT_EQ((P - P.transpose()).norm(), 0.0);
  EXPECT_GT(testing::eigenvaluesOf(P).minCoeff(), 0.0);
}

TEST(PriorJacobian, IsTheDerivativeOfEquation15)
{
  // x_kappa [+] dx [-] x_hat = x_kappa [-] x_hat + J dx.
  constexpr double kStep = 1e-5;
  Random random(31);
  for (const double distance : {0.0, 1e-9, 0.1, 1.0})
  {
    const FilterState prior{random.state(), StateMatrix::Identity()};
    const NavState iterate = iterateNear(random, prior, distance);
    StateMatrix J;
    for (int i = 0; i < kStateDim; ++i)
    {
      const StateVector e = kStep * StateVector::Unit(i);
      J.col(i) =
          (boxminus(boxplus(iterate, e), prior.x) - boxminus(boxplus(iterate, -e), prior.x)) /
          (2.0 * kStep);
    }
    const StateMatrix J_inv = priorJacobianInverse(iterate, prior.x);
    EXPECT_LT((J_inv * J - StateMatrix::Identity()).norm(), 1e-8) << distance;
  }
}

TEST(UpdateStep, BothGainsGiveTheSameStepAndCovariance)
{
  Random random(32);
  for (const int count : {1, 2, 5, 6, 7, 30, 200})
  {
    for (const double spread : {1.0, 1e2, 1e4})
    {
      for (const double distance : {0.0, 0.01, 0.5})
      {
        const FilterState prior{random.state(), random.covariance(0.1, spread)};
        const NavState iterate = iterateNear(random, prior, distance);
        const auto measurements = testing::randomMeasurements(random, count, 0.02);
        const UpdateStep information =
            informationStep(prior, iterate, testing::sumsOf(measurements));
        const UpdateStep standard = standardStep(prior, iterate, measurements);
        EXPECT_LT(difference(information, standard), 1e-7)
            << count << " measurements, spread " << spread << ", distance " << distance;
        expectCovariance(information.P);
        expectCovariance(standard.P);
      }
    }
  }
}

/** Eq. 20 to the letter: K = (H^T R^-1 H + P^-1)^-1 H^T R^-1. */
UpdateStep equation20(
    const FilterState& prior, const NavState& iterate, const StackedMeasurements& m)
{
  const auto rows = static_cast<Eigen::Index>(m.h.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, kStateDim);
  Eigen::MatrixXd R_inv = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::VectorXd z(rows);
  for (Eigen::Index i = 0; i < rows; ++i)
  {
    const auto k = static_cast<std::size_t>(i);
    H.row(i).head<6>() = m.h[k].transpose();
    R_inv(i, i) = 1.0 / m.variance[k];
    z[i] = m.z[k];
  }
  const Eigen::MatrixXd J_inv = priorJacobianInverse(iterate, prior.x);
  const Eigen::MatrixXd P = J_inv * prior.P * J_inv.transpose();
  const Eigen::MatrixXd K =
      (H.transpose() * R_inv * H + P.inverse()).inverse() * H.transpose() * R_inv;
  const Eigen::MatrixXd I_KH = Eigen::MatrixXd::Identity(kStateDim, kStateDim) - K * H;
  UpdateStep step;
  step.dx = -K * z - I_KH * J_inv * boxminus(iterate, prior.x);
  step.P = I_KH * P;
  return step;
}

TEST(UpdateStep, InformationStepIsEquation20ToTheLetter)
{
  Random random(33);
  for (const int count : {3, 10, 100})
  {
    for (const double spread : {1.0, 1e3})
    {
      const FilterState prior{random.state(), random.covariance(0.1, spread)};
      const NavState iterate = iterateNear(random, prior, 0.3);
      const auto measurements = testing::randomMeasurements(random, count, 0.05);
      const UpdateStep expected = equation20(prior, iterate, measurements);
      const UpdateStep step = informationStep(prior, iterate, testing::sumsOf(measurements));
      EXPECT_LT(difference(step, expected), 1e-7) << count << " measurements, spread " << spread;
    }
  }
}

TEST(UpdateStep, WhatIsKnownExactlyStaysAsItIs)
{
  // Zero variance of attitude, gyro bias and gravity: P is singular, eq. 20 as printed fails.
  Random random(34);
  FilterState prior{random.state(), random.covariance(0.1, 10.0)};
  for (const int block : {kAttitude, kGyroBias, kGravity})
  {
    prior.P.middleRows<3>(block).setZero();
    prior.P.middleCols<3>(block).setZero();
  }
  const auto measurements = testing::randomMeasurements(random, 50, 0.05);
  const UpdateStep step = informationStep(prior, prior.x, testing::sumsOf(measurements));
  EXPECT_LT(difference(step, standardStep(prior, prior.x, measurements)), 1e-8);
  for (const int block : {kAttitude, kGyroBias, kGravity})
  {
    EXPECT_LT(step.dx.segment<3>(block).norm(), 1e-15);
    EXPECT_LT(step.P.middleRows<3>(block).norm(), 1e-15);
  }
  EXPECT_GT(step.dx.segment<3>(kPosition).norm(), 1e-6);
}

TEST(UpdateStep, WithoutAnyUncertaintyNothingMoves)
{
  Random random(35);
  const FilterState prior{random.state(), StateMatrix::Zero()};
  const auto measurements = testing::randomMeasurements(random, 50, 0.05);
  const UpdateStep step = informationStep(prior, prior.x, testing::sumsOf(measurements));
  EXPECT_EQ(step.dx.norm(), 0.0);
  EXPECT_EQ(step.P.norm(), 0.0);
}

TEST(UpdateStep, AVeryWeakPriorLeavesWhatTheMeasurementsSay)
{
  // Twelve orders of magnitude between prior and posterior: the pose's posterior is S^-1.
  Random random(36);
  FilterState prior{random.state(), 1e8 * StateMatrix::Identity()};
  const auto sums = testing::sumsOf(testing::randomMeasurements(random, 300, 0.01));
  const UpdateStep step = informationStep(prior, prior.x, sums);
  const Matrix6 expected = sums.HtRinvH.inverse();
  EXPECT_LT((step.P.topLeftCorner<6, 6>() - expected).norm(), 1e-7 * expected.norm());
  const Vector6 dx = -expected * sums.HtRinvz;
  EXPECT_LT((step.dx.head<6>() - dx).norm(), 1e-7 * dx.norm());
}

TEST(UpdateStep, WithoutMeasurementsTheIterateReturnsToThePrior)
{
  Random random(37);
  const FilterState prior{random.state(), random.covariance(0.1, 10.0)};
  const NavState iterate = iterateNear(random, prior, 0.2);
  for (const UpdateStep& step :
       {informationStep(prior, iterate, InformationSums{}),
        standardStep(prior, iterate, StackedMeasurements{})})
  {
    EXPECT_LT(boxminus(boxplus(iterate, step.dx), prior.x).norm(), 1e-13);
    const StateMatrix J_inv = priorJacobianInverse(iterate, prior.x);
    EXPECT_LT((step.P - testing::onBothSides(J_inv, prior.P)).norm(), 1e-14);
  }
}

TEST(UpdateStep, CorrelationsCarryTheCorrectionToVelocityAndBiases)
{
  // One scalar measurement of x with variance r; velocity correlated with it: the textbook gain.
  FilterState prior;
  prior.P = 1e-6 * StateMatrix::Identity();
  prior.P(kPosition, kPosition) = 4.0;
  prior.P(kVelocity, kVelocity) = 9.0;
  prior.P(kPosition, kVelocity) = prior.P(kVelocity, kPosition) = 3.0;
  StackedMeasurements m;
  m.h.push_back(Vector6::Unit(kPosition));
  m.z.push_back(-1.0);  // predicted minus measured
  m.variance.push_back(1.0);
  const UpdateStep step = informationStep(prior, prior.x, testing::sumsOf(m));
  EXPECT_NEAR(step.dx[kPosition], 4.0 / 5.0, 1e-14);
  EXPECT_NEAR(step.dx[kVelocity], 3.0 / 5.0, 1e-14);
  EXPECT_NEAR(step.P(kPosition, kPosition), 4.0 / 5.0, 1e-14);
  EXPECT_NEAR(step.P(kVelocity, kVelocity), 9.0 - 9.0 / 5.0, 1e-14);
  EXPECT_NEAR(step.P(kPosition, kVelocity), 3.0 / 5.0, 1e-14);
}

TEST(UpdateStep, UnevenColumnsAreRefused)
{
  StackedMeasurements m;
  m.h.push_back(Vector6::Unit(0));
  m.z.push_back(0.0);
  EXPECT_THROW((void)standardStep(FilterState{}, NavState{}, m), std::invalid_argument);
}
}  // namespace
}  // namespace fastlio
