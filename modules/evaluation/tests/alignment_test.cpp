// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sample_trajectories.h"
#include <fastlio/evaluation/alignment.h>

#include <Eigen/LU>

namespace fastlio
{
namespace
{
using testing::expectThrows;

AssociatedTrajectories associated(const Trajectory& estimate, const Trajectory& reference)
{
  return associate(estimate, reference, {});
}

double sumOfSquares(const AssociatedTrajectories& t, const Similarity& S)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < t.estimate.size(); ++i)
    sum += ((S * t.estimate[i].T_world_body).p - t.reference[i].T_world_body.p).squaredNorm();
  return sum;
}

void expectNear(const Similarity& S, const Pose& T, double scale)
{
  EXPECT_NEAR(S.scale, scale, 1e-12);
  EXPECT_TRUE(S.T_ref_est.R.isApprox(T.R, 1e-9));
  EXPECT_TRUE(S.T_ref_est.p.isApprox(T.p, 1e-9));
}

TEST(AlignmentTest, RigidTransformationsAreRecovered)
{
  std::mt19937 random(1);
  const Trajectory truth = testing::curve();
  for (int run = 0; run < 50; ++run)
  {
    const Pose T_ref_est = testing::randomPose(random);
    const auto t = associated(testing::moved(T_ref_est.inverse(), truth), truth);
    for (const Alignment kind : {Alignment::First, Alignment::Se3, Alignment::Sim3})
      expectNear(align(t, kind), T_ref_est, 1.0);
  }
}

TEST(AlignmentTest, ScaleIsRecovered)
{
  std::mt19937 random(2);
  const Trajectory truth = testing::curve();
  for (const double scale : {0.2, 0.99, 3.0})
  {
    const Pose T_ref_est = testing::randomPose(random);
    Trajectory estimate = testing::moved(T_ref_est.inverse(), truth);
    for (StampedPose& pose : estimate.poses)
      pose.T_world_body.p /= scale;
    const Similarity S = align(associated(estimate, truth), Alignment::Sim3);
    expectNear(S, T_ref_est, scale);
  }
}

TEST(AlignmentTest, YawAndPositionAreRecovered)
{
  const Trajectory truth = testing::curve();
  for (const double yaw : {-3.1, -1.0, 0.0, 0.4, 2.9})
  {
    const Pose T_ref_est{expSO3({0.0, 0.0, yaw}), Vec3(5, -6, 7)};
    const auto t = associated(testing::moved(T_ref_est.inverse(), truth), truth);
    expectNear(align(t, Alignment::Yaw), T_ref_est, 1.0);
  }
}

TEST(AlignmentTest, YawLeavesTiltAlone)
{
  const Trajectory truth = testing::curve();
  const Pose tilt{expSO3({0.05, -0.03, 0.0}), Vec3::Zero()};
  const Similarity S = align(associated(testing::moved(tilt, truth), truth), Alignment::Yaw);
  EXPECT_TRUE((S.T_ref_est.R * Vec3::UnitZ()).isApprox(Vec3::UnitZ(), 1e-15));
}

TEST(AlignmentTest, NoneIsTheIdentity)
{
  const auto t = associated(testing::shifted(testing::curve(), {1, 2, 3}), testing::curve());
  expectNear(align(t, Alignment::None), Pose{}, 1.0);
}

/** With noise, no transformation near the solution is better. */
TEST(AlignmentTest, TheMinimumIsAMinimum)
{
  std::mt19937 random(3);
  const Trajectory truth = testing::curve();
  Trajectory estimate = testing::moved(testing::randomPose(random), truth);
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.p += testing::gaussian(random, 0.3);
  const auto t = associated(estimate, truth);
  for (const Alignment kind : {Alignment::Yaw, Alignment::Se3, Alignment::Sim3})
  {
    const Similarity best = align(t, kind);
    for (int i = 0; i < 100; ++i)
    {
      const double yaw_only = kind == Alignment::Yaw ? 0.0 : 1.0;
      Similarity other = best;
      const Vec3 turn = testing::gaussian(random, 1e-3).cwiseProduct(Vec3(yaw_only, yaw_only, 1.0));
      other.T_ref_est.R = expSO3(turn) * best.T_ref_est.R;
      other.T_ref_est.p += testing::gaussian(random, 1e-2);
      if (kind == Alignment::Sim3) other.scale += testing::gaussian(random, 1e-3).x();
      EXPECT_GE(sumOfSquares(t, other), sumOfSquares(t, best));
    }
  }
}

TEST(AlignmentTest, MirroredPositionsGiveARotation)
{
  Trajectory mirrored = testing::curve();
  for (StampedPose& pose : mirrored.poses)
    pose.T_world_body.p.z() *= -1.0;
  const Similarity S = align(associated(mirrored, testing::curve()), Alignment::Se3);
  EXPECT_NEAR(S.T_ref_est.R.determinant(), 1.0, 1e-12);
}

TEST(AlignmentTest, PlanarMotionIsEnough)
{
  std::mt19937 random(4);
  Trajectory flat = testing::curve();
  for (StampedPose& pose : flat.poses)
    pose.T_world_body.p.z() = 0.0;
  const Pose T_ref_est = testing::randomPose(random);
  const auto t = associated(testing::moved(T_ref_est.inverse(), flat), flat);
  expectNear(align(t, Alignment::Se3), T_ref_est, 1.0);
}

TEST(AlignmentTest, WhatPositionsLeaveOpenIsAnError)
{
  const auto aligning = [](const Trajectory& t, Alignment kind)
  { return [t, kind] { (void)align(associated(t, t), kind); }; };
  Trajectory resting = testing::curve();
  for (StampedPose& pose : resting.poses)
    pose.T_world_body.p = Vec3(1, 2, 3);
  Trajectory climbing = testing::line();
  for (StampedPose& pose : climbing.poses)
    pose.T_world_body.p = pose.T_world_body.p.reverse().eval();
  for (const Alignment kind : {Alignment::Se3, Alignment::Sim3})
  {
    expectThrows<std::invalid_argument>(aligning(resting, kind), {"one line", "first"});
    expectThrows<std::invalid_argument>(aligning(testing::line(), kind), {"one line", "yaw"});
  }
  expectThrows<std::invalid_argument>(aligning(resting, Alignment::Yaw), {"first"});
  expectThrows<std::invalid_argument>(aligning(climbing, Alignment::Yaw), {"horizontally"});
  EXPECT_NO_THROW(aligning(testing::line(), Alignment::Yaw)());
  EXPECT_NO_THROW(aligning(resting, Alignment::First)());
}

TEST(AlignmentTest, Names)
{
  EXPECT_EQ(toString(Alignment::None), "none");
  EXPECT_EQ(toString(Alignment::Sim3), "sim3");
}

/** 100 m along x with a little beside it, and what an error of some centimetres does. */
AssociatedTrajectories nearlyStraight(double width)
{
  std::mt19937 random(5);
  Trajectory truth = testing::line();
  for (StampedPose& pose : truth.poses)
    pose.T_world_body.p.y() = width * std::sin(0.1 * pose.T_world_body.p.x());
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.p += testing::gaussian(random, 0.03);
  return associated(estimate, truth);
}

TEST(AlignmentTest, ANearlyStraightPathLeavesATurnOpen)
{
  const auto straight = nearlyStraight(0.03);
  const auto turn = uncertainTurn(straight, Alignment::Se3, 0.05);
  ASSERT_TRUE(turn.has_value());
  const double actual = rotationAngle(align(straight, Alignment::Se3).T_ref_est.R);
  EXPECT_GT(actual, 0.02);  // although the attitudes are equal
  EXPECT_GT(*turn, actual);
  EXPECT_TRUE(uncertainTurn(straight, Alignment::Sim3, 0.05).has_value());
  EXPECT_FALSE(uncertainTurn(straight, Alignment::Yaw, 0.05).has_value());
  EXPECT_FALSE(uncertainTurn(straight, Alignment::First, 0.05).has_value());
  EXPECT_FALSE(uncertainTurn(nearlyStraight(20.0), Alignment::Se3, 0.05).has_value());
}

}  // namespace
}  // namespace fastlio
