// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/run/pose_track.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/poses/CPose3DPDFGaussian.h>

namespace fastlio
{
namespace
{
using testing::madeUpResult;

constexpr std::int64_t kTrackStamp = 1'403'636'580'838'555'648;
constexpr std::int64_t kScan = 100'000'000;

ScanResult at(std::int64_t stamp_ns, const Pose& pose)
{
  ScanResult result = madeUpResult(stamp_ns);
  result.filter.x.R = pose.R;
  result.filter.x.p = pose.p;
  return result;
}

TrackedPose tracked(const Pose& pose, double own, double shared)
{
  TrackedPose t;
  t.T_world_body = pose;
  Matrix6 A;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      A(i, j) = 1e-2 * (1 + (5 * i + 3 * j) % 7);
  const Matrix6 twist = shared * A * A.transpose();
  // The map's part is a rigid motion of the world.
  Matrix6 L = Matrix6::Identity();
  L.topLeftCorner<3, 3>() = pose.R.transpose();
  L.bottomLeftCorner<3, 3>() = -skew(pose.p);
  t.map_covariance = L * twist * L.transpose();
  t.covariance = t.map_covariance + own * (A.transpose() * A + 1e-5 * Matrix6::Identity());
  return t;
}

TEST(PoseTrack, GoesThroughThePosesWithConstantVelocity)
{
  const Pose a{expSO3({0.1, 0.2, 0.3}), {1.0, 2.0, 3.0}};
  const Vec3 step_rotation(0.02, -0.01, 0.05), step(0.1, 0.05, -0.02);
  const Pose b{a.R * expSO3(step_rotation), a.p + step};
  const Pose T_imu_body{expSO3({0.0, 0.0, 1.0}), {0.2, 0.0, 0.0}};
  PoseTrack track({"vehicle", T_imu_body});
  track.add(at(kTrackStamp, a));
  track.add(at(kTrackStamp + kScan, b));
  ASSERT_EQ(track.poses().size(), 2U);
  const auto middle = track.at(kTrackStamp + kScan / 2);
  ASSERT_TRUE(middle);
  const Mat3 R_a = a.R * T_imu_body.R;
  const Mat3 R_b = b.R * T_imu_body.R;
  EXPECT_LT(
      logSO3(middle->T_world_body.R.transpose() * R_a).norm() -
          0.5 * logSO3(R_b.transpose() * R_a).norm(),
      1e-12);
  const Vec3 p_a = a * T_imu_body.p;
  const Vec3 p_b = b * T_imu_body.p;
  EXPECT_LT((middle->T_world_body.p - 0.5 * (p_a + p_b)).norm(), 1e-12);
  EXPECT_LT((middle->T_world_body.R * middle->velocity - (p_b - p_a) / 0.1).norm(), 1e-9);
  EXPECT_LT((middle->angular_velocity - logSO3(R_a.transpose() * R_b) / 0.1).norm(), 1e-9);
}

TEST(PoseTrack, KnowsNothingOutsideAndInGaps)
{
  PoseTrack track({});
  EXPECT_FALSE(track.at(kTrackStamp));
  track.add(at(kTrackStamp, {}));
  track.add(at(kTrackStamp + kScan, {}));
  track.add(madeUpResult(kTrackStamp + 2 * kScan, ScanStatus::Diverged));
  track.add(at(kTrackStamp + 30 * kScan, {}));
  EXPECT_EQ(track.poses().size(), 3U);
  EXPECT_TRUE(track.at(kTrackStamp - kScan));       // the first scan's begin
  EXPECT_FALSE(track.at(kTrackStamp - kScan - 1));  // before it
  EXPECT_TRUE(track.at(kTrackStamp + kScan));
  EXPECT_FALSE(track.at(kTrackStamp + 10 * kScan));
  EXPECT_FALSE(track.at(kTrackStamp + 30 * kScan + 1));
}

// A pose that was lost by 2 m jumps to a place in the map, which may be the wrong one: the jump is
// as uncertain as both, though the covariance of the pose stays the same.
TEST(RelativePose, AJumpToAnAmbiguousPlaceIsUncertain)
{
  TrackedPose lost, found;
  lost.map_covariance(3, 3) = found.map_covariance(3, 3) = 4.0;
  lost.covariance = lost.map_covariance;
  found.covariance = found.map_covariance;
  found.ambiguity_covariance(3, 3) = 3.99;
  EXPECT_NEAR(relativePose(lost, found).covariance(3, 3), 7.98, 1e-9);
  EXPECT_NEAR(relativePose(found, found).covariance(3, 3), 0.0, 1e-9);
}

// After a pose that was found anywhere, each motion counted as uncertain by metres and tens of
// degrees for the rest of the run, and a map of it came apart.
TEST(RelativePose, OfPosesBehindAnAmbiguousPlaceIsAsCertainAsBefore)
{
  TrackedPose a, b;
  a.T_world_body = {expSO3({0.0, 0.0, 0.4}), {20.0, -10.0, 1.0}};
  b.T_world_body = a.T_world_body * Pose{expSO3({0.02, 0.1, 1.0}), {3.0, 0.5, 0.0}};
  for (TrackedPose* pose : {&a, &b})
  {
    const Vec3 up = pose->T_world_body.R.transpose() * Vec3::UnitZ();
    pose->ambiguity_covariance.topLeftCorner<3, 3>() = 2.5 * up * up.transpose();
    pose->ambiguity_covariance.bottomRightCorner<3, 3>() = 100.0 * Mat3::Identity();
    pose->map_covariance = pose->covariance = pose->ambiguity_covariance;
  }
  EXPECT_LT(relativePose(a, b).covariance.norm(), 1e-9);
}

/** Without a map's part: the two errors are independent, so numerical derivatives check the
 * analytical ones.
 */
TEST(RelativePose, CovarianceIsThatOfTheErrorsOfBoth)
{
  const TrackedPose a = tracked({expSO3({0.3, -0.2, 0.9}), {1.0, -2.0, 0.5}}, 1.0, 0.0);
  const TrackedPose b = tracked({expSO3({-0.1, 0.4, 1.2}), {2.0, -1.0, 0.7}}, 2.0, 0.0);
  const RelativePose relative = relativePose(a, b);
  constexpr double kStep = 1e-6;
  Matrix6 expected = Matrix6::Zero();
  const auto add = [&](const TrackedPose& of, bool former)
  {
    Matrix6 J;
    for (int i = 0; i < 6; ++i)
    {
      Eigen::Matrix<double, 6, 1> e = Eigen::Matrix<double, 6, 1>::Zero();
      e[i] = kStep;
      const Pose& T = of.T_world_body;
      const Pose moved{T.R * expSO3(e.head<3>()), T.p + e.tail<3>()};
      const Pose now = former ? moved.inverse() * b.T_world_body : a.T_world_body.inverse() * moved;
      J.block<3, 1>(0, i) = logSO3(relative.T_a_b.R.transpose() * now.R) / kStep;
      J.block<3, 1>(3, i) = (now.p - relative.T_a_b.p) / kStep;
    }
    expected += J * of.covariance * J.transpose();
  };
  add(a, true);
  add(b, false);
  EXPECT_LT((relative.covariance - expected).norm(), 1e-5 * expected.norm());
}

TEST(RelativePose, ReversedItHasTheSameErrors)
{
  const TrackedPose a = tracked({expSO3({0.3, -0.2, 0.9}), {1.0, -2.0, 0.5}}, 1.0, 0.0);
  const TrackedPose b = tracked({expSO3({-0.1, 0.4, 1.2}), {2.0, -1.0, 0.7}}, 2.0, 0.0);
  const RelativePose there = relativePose(a, b), back = reversed(there);
  EXPECT_LT((back.T_a_b * there.T_a_b).p.norm(), 1e-12);
  constexpr double kStep = 1e-6;
  Matrix6 J;
  for (int i = 0; i < 6; ++i)
  {
    Eigen::Matrix<double, 6, 1> e = Eigen::Matrix<double, 6, 1>::Zero();
    e[i] = kStep;
    const Pose now =
        Pose{there.T_a_b.R * expSO3(e.head<3>()), there.T_a_b.p + e.tail<3>()}.inverse();
    J.block<3, 1>(0, i) = logSO3(back.T_a_b.R.transpose() * now.R) / kStep;
    J.block<3, 1>(3, i) = (now.p - back.T_a_b.p) / kStep;
  }
  const Matrix6 expected = J * there.covariance * J.transpose();
  EXPECT_LT((back.covariance - expected).norm(), 1e-5 * expected.norm());
  EXPECT_LT((reversed(back).covariance - there.covariance).norm(), 1e-9);
}

/** An error that moves the whole world changes no motion within it. */
TEST(RelativePose, WhatBothShareDoesNotCount)
{
  const Pose A{expSO3({0.3, -0.2, 0.9}), {1.0, -2.0, 0.5}};
  const Pose B{expSO3({-0.1, 0.4, 1.2}), {20.0, -1.0, 0.7}};
  const Matrix6 none = relativePose(tracked(A, 1.0, 0.0), tracked(B, 1.0, 0.0)).covariance;
  const Matrix6 same = relativePose(tracked(A, 1.0, 50.0), tracked(B, 1.0, 50.0)).covariance;
  const Matrix6 grown = relativePose(tracked(A, 1.0, 50.0), tracked(B, 1.0, 60.0)).covariance;
  EXPECT_LT((same - none).norm(), 1e-9 * none.norm() + 1e-12);
  EXPECT_GT(grown.trace(), same.trace() + 1e-3);
}

/** Where somebody has put the origin of the world says nothing about a motion. */
TEST(RelativePose, DoesNotDependOnTheOriginOfTheWorld)
{
  TrackedPose a = tracked({expSO3({0.3, -0.2, 0.9}), {1.0, -2.0, 0.5}}, 1.0, 50.0);
  TrackedPose b = tracked({expSO3({-0.1, 0.4, 1.2}), {2.0, -1.0, 0.7}}, 1.0, 60.0);
  for (Matrix6* covariance : {&b.map_covariance, &b.covariance})
  {
    (*covariance)(0, 0) -= 0.01;  // attitude and height change in opposite ways
    (*covariance)(5, 5) += 0.01;
  }
  const Matrix6 near = relativePose(a, b).covariance;
  const Vec3 away(3000.0, -1000.0, 50.0);
  a.T_world_body.p += away;
  b.T_world_body.p += away;
  const Matrix6 far = relativePose(a, b).covariance;
  EXPECT_LT((far - near).norm(), 1e-3 * near.norm());
}

/** Back in an older part of the map, the motion corrects what had grown on the way: then it is not
 * known better than that. */
TEST(RelativePose, AMapErrorThatShrinksCounts)
{
  const Pose A{expSO3({0.3, -0.2, 0.9}), {1.0, -2.0, 0.5}};
  const Pose B{expSO3({-0.1, 0.4, 1.2}), {2.0, -1.0, 0.7}};
  const Matrix6 same = relativePose(tracked(A, 1.0, 60.0), tracked(B, 1.0, 60.0)).covariance;
  const Matrix6 grown = relativePose(tracked(A, 1.0, 10.0), tracked(B, 1.0, 60.0)).covariance;
  const Matrix6 shrunk = relativePose(tracked(A, 1.0, 60.0), tracked(B, 1.0, 10.0)).covariance;
  EXPECT_GT(grown.trace(), 2.0 * same.trace());
  EXPECT_NEAR(shrunk.trace(), grown.trace(), 0.2 * grown.trace());
}

TEST(MrptPoses, CovarianceIsThatOfTheAngles)
{
  const Pose pose{expSO3({0.5, -0.7, 1.9}), {1.0, 2.0, 3.0}};
  const TrackedPose t = tracked(pose, 1.0, 0.0);
  constexpr double kStep = 1e-7;
  Matrix6 J;
  const auto angles = toMrptPose(pose);
  for (int i = 0; i < 6; ++i)
  {
    Eigen::Matrix<double, 6, 1> e = Eigen::Matrix<double, 6, 1>::Zero();
    e[i] = kStep;
    const auto moved = toMrptPose({pose.R * expSO3(e.head<3>()), pose.p + e.tail<3>()});
    const std::array<double, 6> d = {moved.x() - angles.x(),         moved.y() - angles.y(),
                                     moved.z() - angles.z(),         moved.yaw() - angles.yaw(),
                                     moved.pitch() - angles.pitch(), moved.roll() - angles.roll()};
    for (int k = 0; k < 6; ++k)
      J(k, i) = d.at(static_cast<std::size_t>(k)) / kStep;
  }
  const Matrix6 expected = J * t.covariance * J.transpose();
  const auto seen = mrptCovariance(pose, t.covariance);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      EXPECT_NEAR(seen(row, column), expected(row, column), 1e-5 * expected.norm());
}

TEST(MrptPoses, StaysFiniteWhereAnglesAreNotDefined)
{
  const Pose pose{expSO3({0.0, -1.5707963267948966, 0.0}), {}};
  const auto seen = mrptCovariance(pose, 1e-6 * Matrix6::Identity());
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(std::isfinite(seen(i, i)) && seen(i, i) > 0.0);
}

TEST(MrptPoses, MotionOnGroundTakesTheYawOnly)
{
  TrackedPose a =
      tracked({expSO3({0.0, 0.0, 1.0}) * expSO3({0.2, 0.1, 0.0}), {1.0, 2.0, 5.0}}, 1, 0);
  TrackedPose b = a;
  b.T_world_body.p += expSO3({0.0, 0.0, onGround(a.T_world_body).phi()}) * Vec3(0.5, 0.1, 0.3);
  b.T_world_body.R = expSO3({0.0, 0.0, 0.4}) * a.T_world_body.R;
  const auto motion = motionOnGround(a, b);
  EXPECT_NEAR(motion.mean.x(), 0.5, 1e-12);
  EXPECT_NEAR(motion.mean.y(), 0.1, 1e-12);
  EXPECT_NEAR(motion.mean.phi(), 0.4, 1e-12);
  for (int i = 0; i < 3; ++i)
    EXPECT_GT(motion.cov(i, i), 0.0);
}

TEST(KeyFrameRule, MovesOrTurns)
{
  KeyFrameRule rule(1.0, 0.5);
  EXPECT_TRUE(rule.accept({}));
  EXPECT_FALSE(rule.accept({expSO3({0.0, 0.0, 0.4}), {0.9, 0.0, 0.0}}));
  EXPECT_TRUE(rule.accept({Mat3::Identity(), {1.1, 0.0, 0.0}}));
  EXPECT_TRUE(rule.accept({expSO3({0.0, 0.6, 0.0}), {1.1, 0.0, 0.0}}));
  EXPECT_FALSE(rule.accept({expSO3({0.0, 0.6, 0.0}), {1.2, 0.0, 0.0}}));
}

}  // namespace
}  // namespace fastlio
