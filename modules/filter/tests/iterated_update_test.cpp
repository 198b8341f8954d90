// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "measurement_problems.h"
#include <fastlio/filter/update.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <vector>

namespace fastlio
{
namespace
{
using testing::kSigma;
using testing::Problem;
using testing::problemOff;
using testing::Random;
using testing::tightLimits;

TEST(IteratedUpdate, ExactPlanesRecoverThePose)
{
  Random random(41);
  for (int i = 0; i < 20; ++i)
  {
    Problem p = problemOff(random, 0.2);
    p.prior.P = StateMatrix::Identity();
    const auto model =
        testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 200, 0.0), 1e-5);
    const UpdateResult r = iteratedUpdate(p.prior, model, tightLimits(), GainForm::Information);
    EXPECT_TRUE(r.updated);
    EXPECT_TRUE(r.converged);
    EXPECT_LT(boxminus(r.posterior.x, p.truth).head<6>().norm(), 1e-8);
    EXPECT_LT(r.last.weighted_squares, 1e-6);
    EXPECT_EQ(r.last.count, 200u);
  }
}

TEST(IteratedUpdate, IteratingIsWhatRemovesTheNonlinearity)
{
  Random random(42);
  Problem p = problemOff(random, 0.2);
  p.prior.P = StateMatrix::Identity();
  const auto model =
      testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 200, 0.0), 1e-5);
  const auto error = [&](int iterations)
  {
    const auto limits = tightLimits(iterations);
    const UpdateResult r = iteratedUpdate(p.prior, model, limits, GainForm::Information);
    return boxminus(r.posterior.x, p.truth).head<6>().norm();
  };
  EXPECT_GT(error(1), 1e-3);
  EXPECT_LT(error(2), 0.2 * error(1));
  EXPECT_LT(error(5), 1e-6);
}

TEST(IteratedUpdate, BothGainsEndAtTheSamePosterior)
{
  Random random(43);
  for (const int count : {4, 20, 150})
  {
    const Problem p = problemOff(random, 0.1);
    const auto model =
        testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), count, kSigma), kSigma);
    const UpdateResult a = iteratedUpdate(p.prior, model, tightLimits(), GainForm::Information);
    const UpdateResult b = iteratedUpdate(p.prior, model, tightLimits(), GainForm::Standard);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_LT(boxminus(a.posterior.x, b.posterior.x).norm(), 1e-9);
    EXPECT_LT((a.posterior.P - b.posterior.P).norm(), 1e-9 * a.posterior.P.norm());
  }
}

// The start decides how soon the update converges, not what it says: the prior counts once.
TEST(IteratedUpdate, EndsAtTheSamePosteriorFromAnyStart)
{
  Random random(47);
  const Problem p = problemOff(random, 0.2);
  const auto model =
      testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 60, kSigma), kSigma);
  const UpdateResult a = iteratedUpdate(p.prior, model, tightLimits(), GainForm::Information);
  const UpdateResult b =
      iteratedUpdate(p.prior, p.truth, model, tightLimits(), GainForm::Information);
  ASSERT_TRUE(a.converged && b.converged);
  EXPECT_LT(b.iterations, a.iterations);
  EXPECT_LT(boxminus(a.posterior.x, b.posterior.x).norm(), 1e-9);
  EXPECT_LT((a.posterior.P - b.posterior.P).norm(), 1e-9 * a.posterior.P.norm());
}

/** Eq. 17: |x [-] x_hat|^2 weighted by P_hat^-1 plus the sum of z^2 / r. */
double mapCost(
    const FilterState& prior, const NavState& x, const std::vector<testing::PlaneMatch>& m)
{
  const StateVector d = boxminus(x, prior.x);
  return testing::weightedSquare(d, prior.P) +
         testing::sumsOf(testing::residualsOf(m, x, kSigma)).weighted_squares;
}

TEST(IteratedUpdate, EndsAtTheMaximumAPosteriori)
{
  constexpr double kStep = 1e-5;
  Random random(44);
  for (int i = 0; i < 10; ++i)
  {
    const Problem p = problemOff(random, 0.3);
    const auto matches = testing::planesSeenFrom(random, p.truth.pose(), 40, kSigma);
    const UpdateResult r = iteratedUpdate(
        p.prior, testing::planeModel(matches, kSigma), tightLimits(), GainForm::Information);
    ASSERT_TRUE(r.converged);
    StateVector gradient;
    for (int c = 0; c < kStateDim; ++c)
    {
      const StateVector e = kStep * StateVector::Unit(c);
      gradient[c] = (mapCost(p.prior, boxplus(r.posterior.x, e), matches) -
                     mapCost(p.prior, boxplus(r.posterior.x, -e), matches)) /
                    (2.0 * kStep);
    }
    // Slope in units of the posterior's standard deviation: far below one.
    EXPECT_LT((r.posterior.P * gradient).dot(gradient), 1e-10);
  }
}

TEST(IteratedUpdate, PosteriorCovarianceIsThatOfTheErrors)
{
  // Draw truths from the prior and noise from R: e^T P_bar^-1 e averages to the dimension.
  Random random(45);
  constexpr int kRuns = 400;
  double nees = 0.0;
  for (int i = 0; i < kRuns; ++i)
  {
    Problem p = problemOff(random, 0.03);
    const StateMatrix L = p.prior.P.llt().matrixL();
    p.truth = boxplus(p.prior.x, L * random.stateVector(1.0));
    const auto matches = testing::planesSeenFrom(random, p.truth.pose(), 30, kSigma);
    const UpdateResult r = iteratedUpdate(
        p.prior, testing::planeModel(matches, kSigma), tightLimits(), GainForm::Information);
    const StateVector e = boxminus(p.truth, r.posterior.x);
    nees += testing::weightedSquare(e, r.posterior.P) / kRuns;
  }
  // Standard deviation of the average: sqrt(2 * 18 / 400) = 0.3.
  EXPECT_NEAR(nees, kStateDim, 1.0);
}

TEST(IteratedUpdate, PosteriorCovarianceIsSymmetricPositiveAndSmaller)
{
  Random random(46);
  for (int i = 0; i < 20; ++i)
  {
    const Problem p = problemOff(random, 0.1);
    const auto model =
        testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 500, kSigma), kSigma);
    const UpdateResult r = iteratedUpdate(p.prior, model, IterationLimits{}, GainForm::Information);
    EXPECT_EQ((r.posterior.P - r.posterior.P.transpose()).norm(), 0.0);
    EXPECT_GT(testing::eigenvaluesOf(r.posterior.P).minCoeff(), 0.0);
    EXPECT_LT(r.posterior.P.trace(), p.prior.P.trace());
    EXPECT_LT((r.posterior.x.R * r.posterior.x.R.transpose() - Mat3::Identity()).norm(), 1e-14);
  }
}

TEST(IteratedUpdate, CovarianceRefersToThePosteriorsTangentSpace)
{
  // One large step: the covariance of the step is at the prior, the posterior's a rotation away.
  Random random(47);
  const Problem p = problemOff(random, 0.3);
  const auto model =
      testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 5, kSigma), kSigma);
  const UpdateResult r = iteratedUpdate(p.prior, model, tightLimits(1), GainForm::Information);
  const UpdateStep step = informationStep(p.prior, p.prior.x, model(p.prior.x, 0).sums);
  const StateMatrix J_inv = priorJacobianInverse(r.posterior.x, p.prior.x);
  EXPECT_GT((r.posterior.P - step.P).norm(), 1e-3 * step.P.norm());
  EXPECT_LT((r.posterior.P - testing::onBothSides(J_inv, step.P)).norm(), 1e-13 * step.P.norm());
}

TEST(IteratedUpdate, ACorridorLeavesItsAxisToThePrior)
{
  // Walls, floor and ceiling fix all but the position along x, which must neither move nor shrink.
  Random random(48);
  FilterState prior;
  prior.P = 1e-2 * StateMatrix::Identity();
  NavState truth;
  truth.p = Vec3(0.5, 0.05, -0.04);
  const auto matches =
      testing::planesSeenFrom(random, truth.pose(), 300, 0.0, {Vec3::UnitY(), Vec3::UnitZ()});
  const UpdateResult r = iteratedUpdate(
      prior, testing::planeModel(matches, kSigma), tightLimits(), GainForm::Information);
  EXPECT_TRUE(r.converged);
  EXPECT_NEAR(r.posterior.x.p.x(), 0.0, 1e-4);
  EXPECT_NEAR(r.posterior.P(kPosition, kPosition), 1e-2, 1e-5);
  EXPECT_NEAR(r.posterior.x.p.y(), 0.05, 1e-4);
  EXPECT_LT(r.posterior.P(kPosition + 1, kPosition + 1), 1e-5);
}
}  // namespace
}  // namespace fastlio
