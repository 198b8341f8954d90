// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "measurement_problems.h"
#include <fastlio/filter/update.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
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

/** A measurement that pulls the position along x by a fixed amount in every iteration. */
MeasurementModel pull(double amount)
{
  return [amount](const NavState&, int)
  {
    StackedMeasurements m;
    m.h.push_back(Vector6::Unit(kPosition));
    m.z.push_back(-amount);
    m.variance.push_back(1e-12);
    MeasurementEvaluation e;
    e.sums = testing::sumsOf(m);
    e.stacked = m;
    return e;
  };
}

TEST(IteratedUpdateLimits, StopsAtTheIterationLimit)
{
  FilterState prior;
  prior.P = StateMatrix::Identity();
  for (const int limit : {1, 3, 7})
  {
    IterationLimits limits;
    limits.max_iterations = limit;
    std::vector<int> seen;
    const MeasurementModel model = [&seen](const NavState& x, int iteration)
    {
      seen.push_back(iteration);
      return pull(1.0)(x, iteration);
    };
    const UpdateResult r = iteratedUpdate(prior, model, limits, GainForm::Information);
    EXPECT_EQ(r.iterations, limit);
    EXPECT_FALSE(r.converged);
    EXPECT_TRUE(r.updated);
    EXPECT_NEAR(r.posterior.x.p.x(), limit, 1e-6);
    ASSERT_EQ(seen.size(), static_cast<std::size_t>(limit));
    for (int i = 0; i < limit; ++i)
      EXPECT_EQ(seen[static_cast<std::size_t>(i)], i);
  }
}

TEST(IteratedUpdateLimits, EachComponentHasItsOwnThreshold)
{
  // Every component is fully correlated with the position, so that one pull moves all of them by
  // the same amount; tightening the limit of any one of them must keep the filter iterating.
  FilterState prior;
  prior.P = StateMatrix::Ones() + 1e-9 * StateMatrix::Identity();
  const IterationLimits loose{4, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  ASSERT_EQ(iteratedUpdate(prior, pull(1e-2), loose, GainForm::Information).iterations, 1);
  for (double IterationLimits::*limit :
       {&IterationLimits::attitude, &IterationLimits::position, &IterationLimits::velocity,
        &IterationLimits::gyro_bias, &IterationLimits::accel_bias, &IterationLimits::gravity})
  {
    IterationLimits limits = loose;
    limits.*limit = 1e-3;
    const UpdateResult r = iteratedUpdate(prior, pull(1e-2), limits, GainForm::Information);
    EXPECT_EQ(r.iterations, 4);
    EXPECT_FALSE(r.converged);
  }
}

void expectUntouched(const UpdateResult& r, const FilterState& prior)
{
  EXPECT_FALSE(r.updated);
  EXPECT_FALSE(r.converged);
  EXPECT_EQ(r.posterior.P, prior.P);
  EXPECT_EQ(r.posterior.x.R, prior.x.R);
  EXPECT_EQ(r.posterior.x.p, prior.x.p);
  EXPECT_EQ(r.posterior.x.v, prior.x.v);
  EXPECT_EQ(r.posterior.x.g, prior.x.g);
}

TEST(IteratedUpdateLimits, WithoutMeasurementsThePriorStays)
{
  Random random(49);
  const Problem p = problemOff(random, 0.1);
  const MeasurementModel none = [](const NavState&, int) { return MeasurementEvaluation{}; };
  for (const GainForm gain : {GainForm::Information, GainForm::Standard})
  {
    const UpdateResult r = iteratedUpdate(p.prior, none, IterationLimits{}, gain);
    expectUntouched(r, p.prior);
    EXPECT_EQ(r.iterations, 1);
  }
}

TEST(IteratedUpdateLimits, MatchesLostOnTheWayLeaveThePrior)
{
  Random random(50);
  const Problem p = problemOff(random, 0.2);
  const auto planes =
      testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 50, kSigma), kSigma);
  const MeasurementModel model = [&planes](const NavState& x, int iteration)
  { return iteration == 0 ? planes(x, 0) : MeasurementEvaluation{}; };
  const UpdateResult r = iteratedUpdate(p.prior, model, tightLimits(), GainForm::Information);
  expectUntouched(r, p.prior);
  EXPECT_EQ(r.iterations, 2);
}

TEST(IteratedUpdateLimits, NonFiniteNumbersNeverEnterTheState)
{
  Random random(51);
  const Problem p = problemOff(random, 0.2);
  const auto planes =
      testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 50, kSigma), kSigma);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
  {
    for (const int when : {0, 1})
    {
      const MeasurementModel model = [&planes, bad, when](const NavState& x, int iteration)
      {
        MeasurementEvaluation e = planes(x, iteration);
        if (iteration != when) return e;
        e.stacked.z[3] = bad;
        e.sums = testing::sumsOf(e.stacked);
        return e;
      };
      for (const GainForm gain : {GainForm::Information, GainForm::Standard})
      {
        const UpdateResult r = iteratedUpdate(p.prior, model, tightLimits(), gain);
        expectUntouched(r, p.prior);
        EXPECT_EQ(r.iterations, when + 1);
      }
    }
  }
}

TEST(IteratedUpdateLimits, ANonFiniteStepFromFiniteSumsIsNotTaken)
{
  Random random(52);
  Problem p = problemOff(random, 0.1);
  p.prior.P(kVelocity, kVelocity) = std::numeric_limits<double>::infinity();
  const auto model =
      testing::planeModel(testing::planesSeenFrom(random, p.truth.pose(), 50, kSigma), kSigma);
  for (const GainForm gain : {GainForm::Information, GainForm::Standard})
  {
    expectUntouched(iteratedUpdate(p.prior, model, IterationLimits{}, gain), p.prior);
  }
}

TEST(IteratedUpdateLimits, WrongUseIsRefused)
{
  FilterState prior;
  prior.P = StateMatrix::Identity();
  IterationLimits none;
  none.max_iterations = 0;
  EXPECT_THROW(
      (void)iteratedUpdate(prior, pull(1.0), none, GainForm::Information), std::invalid_argument);
  const MeasurementModel sums_only = [](const NavState& x, int iteration)
  {
    MeasurementEvaluation e;
    e.sums = pull(1.0)(x, iteration).sums;
    return e;
  };
  EXPECT_THROW(
      (void)iteratedUpdate(prior, sums_only, IterationLimits{}, GainForm::Standard),
      std::invalid_argument);
}
}  // namespace
}  // namespace fastlio
