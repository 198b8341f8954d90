// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_problems.h"
#include <fastlio/filter/backward_propagation.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/filter/state.h>
#include <fastlio/filter/update.h>

#include <gtest/gtest.h>

#include <limits>

namespace fastlio
{
namespace
{
/** A step whose rotations are less than pi, where boxminus inverts boxplus. */
StateVector randomStep(testing::Random& random)
{
  StateVector dx = random.stateVector(1.0);
  for (const StateBlock block : {kAttitude, kExtrinsicRotation})
    dx.segment<3>(block) = random.uniform(0.0, 3.14) * random.axis();
  return dx;
}

TEST(State, BoxplusOfZeroIsTheSameState)
{
  testing::Random random(1);
  const NavState x = random.state();
  EXPECT_EQ(boxminus(boxplus(x, StateVector::Zero()), x).segment<15>(kPosition).norm(), 0.0);
  EXPECT_LT(boxminus(x, x).norm(), 1e-15);
}

TEST(State, BoxminusInvertsBoxplus)
{
  testing::Random random(2);
  for (int i = 0; i < 500; ++i)
  {
    const NavState x = random.state();
    const StateVector dx = randomStep(random);
    EXPECT_LT((boxminus(boxplus(x, dx), x) - dx).norm(), 1e-13);
  }
}

TEST(State, BoxplusInvertsBoxminus)
{
  testing::Random random(3);
  for (int i = 0; i < 500; ++i)
  {
    const NavState a = random.state();
    const NavState b = random.state();
    const NavState again = boxplus(b, boxminus(a, b));
    EXPECT_LT((again.R - a.R).norm(), 1e-13);
    EXPECT_LT(boxminus(again, a).norm(), 1e-13);
  }
}

TEST(State, BoxminusIsADistance)
{
  // |a [-] b| is symmetric and obeys the triangle inequality, as the axioms of [+] demand.
  testing::Random random(4);
  for (int i = 0; i < 200; ++i)
  {
    const NavState a = random.state();
    const NavState b = random.state();
    const NavState c = random.state();
    EXPECT_NEAR(boxminus(a, b).norm(), boxminus(b, a).norm(), 1e-12);
    EXPECT_LE(boxminus(a, c).norm(), boxminus(a, b).norm() + boxminus(b, c).norm() + 1e-12);
  }
}

TEST(State, AttitudeErrorIsInTheBodyFrame)
{
  testing::Random random(5);
  const NavState x = random.state();
  StateVector dx = StateVector::Zero();
  dx.segment<3>(kAttitude) = Vec3(0.1, -0.2, 0.3);
  EXPECT_LT((boxplus(x, dx).R - x.R * expSO3(Vec3(0.1, -0.2, 0.3))).norm(), 1e-15);
}

TEST(State, BlocksAreWhereTheErrorStateSaysTheyAre)
{
  StateVector dx;
  for (int i = 0; i < kStateDim; ++i)
    dx[i] = 0.01 * (i + 1);
  NavState zero;
  zero.g.setZero();
  const NavState x = boxplus(zero, dx);
  EXPECT_EQ(x.p, Vec3(dx.segment<3>(3)));
  EXPECT_EQ(x.v, Vec3(dx.segment<3>(6)));
  EXPECT_EQ(x.gyro_bias, Vec3(dx.segment<3>(9)));
  EXPECT_EQ(x.accel_bias, Vec3(dx.segment<3>(12)));
  EXPECT_EQ(x.g, Vec3(dx.segment<3>(15)));
  EXPECT_LT((logSO3(x.extrinsic_correction.R) - dx.segment<3>(18)).norm(), 1e-15);
  EXPECT_EQ(x.extrinsic_correction.p, Vec3(dx.segment<3>(21)));
  EXPECT_EQ(x.time_offset, dx[24]);
}

TEST(State, NonFiniteNumbersAreSeenInEveryComponent)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(isFinite(NavState{}));
  for (const double bad : {nan, inf, -inf})
  {
    NavState x;
    x.R(2, 1) = bad;
    EXPECT_FALSE(isFinite(x));
    for (Vec3 NavState::*member :
         {&NavState::p, &NavState::v, &NavState::gyro_bias, &NavState::accel_bias, &NavState::g})
    {
      NavState y;
      (y.*member).z() = bad;
      EXPECT_FALSE(isFinite(y));
    }
    NavState rotation, translation, time;
    rotation.extrinsic_correction.R(0, 1) = bad;
    translation.extrinsic_correction.p.y() = bad;
    time.time_offset = bad;
    for (const NavState& y : {rotation, translation, time})
      EXPECT_FALSE(isFinite(y));
  }
}

TEST(State, PoseTransformsCompose)
{
  testing::Random random(6);
  const Pose a = random.state().pose();
  const Pose b = random.state().pose();
  const Vec3 point = random.vector();
  EXPECT_LT(((a * b) * point - a * (b * point)).norm(), 1e-12);
  EXPECT_LT((a.inverse() * (a * point) - point).norm(), 1e-12);
}

/** Size and alignment that a compiler flag such as -march=native cannot change. */
template <class T>
constexpr bool hasPlainLayout(std::size_t doubles)
{
  return alignof(T) <= alignof(double) && sizeof(T) == doubles * sizeof(double);
}

TEST(State, LayoutOfPublicTypesDoesNotDependOnCompilerFlags)
{
  EXPECT_TRUE(hasPlainLayout<Pose>(12));
  EXPECT_TRUE(hasPlainLayout<NavState>(24 + 13));
  EXPECT_TRUE(hasPlainLayout<FilterState>(24 + 13 + 625));
  EXPECT_TRUE(hasPlainLayout<ImuSample>(7));
  EXPECT_TRUE(hasPlainLayout<ImuNoise>(4));
  EXPECT_TRUE(hasPlainLayout<MotionKnot>(1 + 9 + 12));
  EXPECT_TRUE(hasPlainLayout<ProcessJacobians>(625 + 25 * 12));
  EXPECT_TRUE(hasPlainLayout<NoiseVector>(12));
  EXPECT_TRUE(hasPlainLayout<InformationSums>(36 + 6 + 3));
  EXPECT_TRUE(hasPlainLayout<UpdateStep>(25 + 625 + 25 * 6));
  EXPECT_LE(alignof(StackedMeasurements), 8u);
  EXPECT_LE(alignof(MeasurementEvaluation), 8u);
  EXPECT_LE(alignof(UpdateResult), 8u);
  EXPECT_LE(alignof(IterationLimits), 8u);
}
}  // namespace
}  // namespace fastlio
