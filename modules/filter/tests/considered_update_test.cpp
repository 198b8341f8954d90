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

MeasurementEvaluation evaluationOf(const StackedMeasurements& m)
{
  MeasurementEvaluation e;
  e.sums = testing::sumsOf(m);
  return e;
}

UpdateStep consideringStepWithCovariance(
    const FilterState& prior, const NavState& iterate, const UpdateStep& full,
    const MeasurementEvaluation& evaluation)
{
  UpdateStep step = consideringStep(prior, iterate, full, evaluation);
  step.P = consideringCovariance(prior, iterate, step.gain, evaluation);
  return step;
}

TEST(ConsideringStep, IsTheFullStepWhenAllDirectionsAreConstrained)
{
  Random random(71);
  const FilterState prior{random.state(), random.covariance(0.1, 10.0)};
  const NavState iterate = boxplus(prior.x, random.stateVector(0.05));
  const auto evaluation = evaluationOf(testing::randomMeasurements(random, 50, 0.02));
  const UpdateStep full = informationStep(prior, iterate, evaluation.sums);
  const UpdateStep same = consideringStepWithCovariance(prior, iterate, full, evaluation);
  EXPECT_LT((same.dx - full.dx).norm(), 1e-12);
  EXPECT_LT((same.P - full.P).norm(), 1e-9 * full.P.norm());
}

TEST(ConsideringStep, LeavesTheDirectionAloneInAllBlocks)
{
  Random random(72);
  const FilterState prior{random.state(), random.covariance(0.1, 10.0)};
  auto evaluation = evaluationOf(testing::randomMeasurements(random, 50, 0.02));
  const Vec3 u = random.axis();
  evaluation.unconstrained = {{false, u}};
  const UpdateStep full = informationStep(prior, prior.x, evaluation.sums);
  const UpdateStep step = consideringStepWithCovariance(prior, prior.x, full, evaluation);
  const Vec3 u_body = prior.x.R.transpose() * u;
  for (const auto& [block, axis] :
       {std::pair(kPosition, u), std::pair(kVelocity, u), std::pair(kAccelBias, u_body),
        std::pair(kGravity, u)})
  {
    EXPECT_NEAR(axis.dot(step.dx.segment<3>(block)), 0.0, 1e-14);
    EXPECT_NEAR(
        axis.dot(step.P.block<3, 3>(block, block) * axis),
        axis.dot(prior.P.block<3, 3>(block, block) * axis), 1e-12);
  }
  EXPECT_GT(step.dx.segment<3>(kPosition).norm(), 1e-4) << "across the direction it moves";
  EXPECT_LT(step.P.trace(), prior.P.trace());
  EXPECT_GT(testing::eigenvaluesOf(step.P).minCoeff(), 0.0);
}

// The scan pose is known well, the calibration hardly: the gain of body pose and calibration each
// is large, with opposite signs. Taking one without the other would throw the scan off.
TEST(ConsideringStep, LeavesTheCalibrationAloneAndMovesTheScanAsTheFullStep)
{
  Random random(75);
  FilterState prior{random.state(), random.covariance(1e-3, 1e-2)};
  prior.P.block<3, 3>(kExtrinsicTranslation, kExtrinsicTranslation) += 0.04 * Mat3::Identity();
  prior.P.block<3, 3>(kPosition, kPosition) += 0.04 * Mat3::Identity();
  prior.P.block<3, 3>(kPosition, kExtrinsicTranslation) -= 0.04 * prior.x.R;
  prior.P.block<3, 3>(kExtrinsicTranslation, kPosition) -= 0.04 * prior.x.R.transpose();
  auto evaluation = evaluationOf(testing::randomMeasurements(random, 50, 0.02));
  evaluation.by_state = scanPoseJacobian(
      prior.x, {prior.x.extrinsic_correction, prior.x.time_offset, random.vector(1.0)});
  evaluation.unconstrained = {{true, random.axis()}};
  const UpdateStep full = informationStep(prior, prior.x, evaluation.sums, evaluation.by_state);
  const UpdateStep step = consideringStepWithCovariance(prior, prior.x, full, evaluation);
  EXPECT_EQ(step.dx.tail<kCalibrationDim>().norm(), 0.0);
  EXPECT_GT(full.dx.tail<kCalibrationDim>().norm(), 1e-4);
  const Vector6 moved = evaluation.by_state * step.dx, full_move = evaluation.by_state * full.dx;
  EXPECT_LT((moved - full_move).tail<3>().norm(), 1e-9);
  const auto variance = [&](const StateMatrix& P)
  {
    const Matrix6 C = evaluation.by_state * P * evaluation.by_state.transpose();
    return C.bottomRightCorner<3, 3>().trace();
  };
  EXPECT_LT(variance(step.P), variance(prior.P));
}

TEST(ConsideringStep, LeavesARotationAlone)
{
  Random random(73);
  const FilterState prior{random.state(), random.covariance(0.1, 10.0)};
  auto evaluation = evaluationOf(testing::randomMeasurements(random, 50, 0.02));
  evaluation.unconstrained = {{true, Vec3::UnitZ()}};
  const UpdateStep full = informationStep(prior, prior.x, evaluation.sums);
  const UpdateStep step = consideringStepWithCovariance(prior, prior.x, full, evaluation);
  EXPECT_NEAR(step.dx[kAttitude + 2], 0.0, 1e-14);
  EXPECT_NEAR(step.dx[kGyroBias + 2], 0.0, 1e-14);
  EXPECT_GT(std::abs(step.dx[kAttitude]), 1e-6);
}

TEST(ConsideringStep, NoisyDirectionsDoNotPileUpKnowledge)
{
  // One direction is never measured, but each scan takes a slightly tilted one for it.
  Random random(74);
  FilterState estimate;
  estimate.P = 1e-2 * StateMatrix::Identity();
  FilterState fooled = estimate;
  for (int k = 0; k < 200; ++k)
  {
    StackedMeasurements m;
    const Vec3 tilted = (Vec3::UnitY() + 0.01 * random.normal() * Vec3::UnitX()).normalized();
    Vector6 h = Vector6::Zero();
    h.tail<3>() = tilted;
    m.h.push_back(h);
    m.z.push_back(0.0);
    m.variance.push_back(1e-8);
    MeasurementEvaluation evaluation = evaluationOf(m);
    evaluation.unconstrained = {{false, Vec3::UnitX()}};
    const auto model = [&](const NavState&, int) { return evaluation; };
    estimate = iteratedUpdate(estimate, model, {}, GainForm::Information).posterior;
    evaluation.unconstrained.clear();
    fooled = iteratedUpdate(fooled, model, {}, GainForm::Information).posterior;
  }
  EXPECT_LT(fooled.P(kPosition, kPosition), 1e-5) << "the problem exists";
  EXPECT_NEAR(estimate.P(kPosition, kPosition), 1e-2, 1e-9);
}
}  // namespace
}  // namespace fastlio
