// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "measurement_problems.h"
#include <fastlio/filter/update.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
using testing::Random;

/** A B as of a moving sensor: regular pose columns, all others filled. */
ScanPoseJacobian randomJacobian(Random& random)
{
  NavState x = random.state();
  CompensatedWith c;
  c.extrinsic_correction = {expSO3(random.vector(0.1)), random.vector(0.2)};
  c.time_offset = 0.01;
  c.angular_rate = random.vector(2.0);
  return scanPoseJacobian(x, c);
}

TEST(CalibrationUpdate, BothGainsAgreeOnAllColumns)
{
  Random random(51);
  for (const int count : {1, 6, 40})
  {
    const FilterState prior{random.state(), random.covariance(0.1, 100.0)};
    const NavState iterate = boxplus(prior.x, random.stateVector(0.05));
    const auto measurements = testing::randomMeasurements(random, count, 0.02);
    const ScanPoseJacobian B = randomJacobian(random);
    const UpdateStep a = informationStep(prior, iterate, testing::sumsOf(measurements), B);
    const UpdateStep b = standardStep(prior, iterate, measurements, B);
    EXPECT_LT((a.dx - b.dx).norm(), 1e-7 * (1e-3 + b.dx.norm())) << count;
    EXPECT_LT((a.P - b.P).norm(), 1e-7 * b.P.norm()) << count;
    EXPECT_GT(b.dx.tail<kCalibrationDim>().norm(), 1e-6) << "the calibration takes part";
  }
}

TEST(CalibrationUpdate, AKnownCalibrationStaysAsItIs)
{
  Random random(52);
  FilterState prior{random.state(), random.covariance(0.1, 10.0)};
  prior.P.bottomRows<kCalibrationDim>().setZero();
  prior.P.rightCols<kCalibrationDim>().setZero();
  const auto sums = testing::sumsOf(testing::randomMeasurements(random, 50, 0.02));
  const UpdateStep step = informationStep(prior, prior.x, sums, randomJacobian(random));
  EXPECT_EQ(step.dx.tail<kCalibrationDim>().norm(), 0.0);
  EXPECT_EQ(step.P.bottomRows<kCalibrationDim>().norm(), 0.0);
  EXPECT_GT(step.dx.head<6>().norm(), 1e-6);
}

/** Residuals on known planes of points that were measured with a wrong extrinsic and time offset.
 */
struct MiscalibratedScan
{
  std::vector<testing::PlaneMatch> matches;  //!< points compensated with the calibration assumed
  CompensatedWith compensation;

  MeasurementEvaluation operator()(const NavState& iterate, int) const
  {
    const Pose T = scanPose(iterate, compensation);
    NavState at = iterate;
    at.R = T.R;
    at.p = T.p;
    StackedMeasurements m = testing::residualsOf(matches, at, testing::kSigma);
    MeasurementEvaluation e;
    e.sums = testing::sumsOf(m);
    e.stacked = std::move(m);
    e.by_state = scanPoseJacobian(iterate, compensation);
    return e;
  }
};

MiscalibratedScan scanOf(Random& random, const NavState& truth, const NavState& assumed)
{
  MiscalibratedScan scan;
  scan.compensation.extrinsic_correction = assumed.extrinsic_correction;
  scan.compensation.time_offset = assumed.time_offset;
  scan.compensation.angular_rate = random.vector(2.0);
  scan.matches = testing::planesSeenFrom(random, scanPose(truth, scan.compensation), 200, 0.0);
  return scan;
}

TEST(CalibrationUpdate, MotionRevealsExtrinsicAndTimeOffset)
{
  // The body's pose and motion are known well, and differ from scan to scan.
  Random random(53);
  FilterState estimate;
  estimate.P.diagonal().tail<kCalibrationDim>().setConstant(0.01);
  Pose true_correction{expSO3(Vec3(0.05, -0.03, 0.08)), Vec3(0.1, -0.05, 0.07)};
  const double true_offset = 0.012;
  for (int k = 0; k < 10; ++k)
  {
    NavState truth = random.state();
    truth.extrinsic_correction = true_correction;
    truth.time_offset = true_offset;
    NavState assumed = truth;
    assumed.extrinsic_correction = estimate.x.extrinsic_correction;
    assumed.time_offset = estimate.x.time_offset;
    estimate.x = assumed;
    estimate.P.topLeftCorner<kNavigationDim, kNavigationDim>().setZero();
    estimate.P.diagonal().head<kNavigationDim>().setConstant(1e-8);
    estimate.P.topRightCorner<kNavigationDim, kCalibrationDim>().setZero();
    estimate.P.bottomLeftCorner<kCalibrationDim, kNavigationDim>().setZero();
    const auto result = iteratedUpdate(
        estimate, scanOf(random, truth, assumed), testing::tightLimits(), GainForm::Information);
    ASSERT_TRUE(result.updated);
    estimate = result.posterior;
  }
  const Pose error = true_correction.inverse() * estimate.x.extrinsic_correction;
  EXPECT_LT(logSO3(error.R).norm(), 1e-3);
  EXPECT_LT(error.p.norm(), 2e-3);
  EXPECT_NEAR(estimate.x.time_offset, true_offset, 5e-4);
  EXPECT_LT(std::sqrt(estimate.P(kTimeOffset, kTimeOffset)), 5e-4);
}

TEST(CalibrationUpdate, WhatMotionDoesNotShowKeepsItsPrior)
{
  // At rest the time offset does nothing to the points.
  Random random(54);
  FilterState prior{random.state(), 1e-4 * StateMatrix::Identity()};
  prior.x.v.setZero();
  prior.P.middleRows<3>(kVelocity).setZero();
  prior.P.middleCols<3>(kVelocity).setZero();
  MiscalibratedScan scan = scanOf(random, prior.x, prior.x);
  scan.compensation.angular_rate.setZero();
  const auto result = iteratedUpdate(prior, scan, testing::tightLimits(), GainForm::Information);
  EXPECT_EQ(result.posterior.x.time_offset, prior.x.time_offset);
  EXPECT_NEAR(result.posterior.P(kTimeOffset, kTimeOffset), 1e-4, 1e-15);
}
}  // namespace
}  // namespace fastlio
