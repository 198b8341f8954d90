// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sample_trajectories.h"
#include <fastlio/evaluation/association.h>
#include <fastlio/math/time.h>

#include <limits>

namespace fastlio
{
namespace
{
using testing::expectThrows;
using testing::kStart;

TEST(Association, InterpolationFollowsAScrewExactly)
{
  // Constant rate and constant velocity: linear and geodesic interpolation are exact.
  const auto screw = [](double s) {
    return Pose{expSO3({0.3, -0.2, 0.1}) * expSO3(s * Vec3(0.5, 1.0, -2.0)), s * Vec3(1, 2, 3)};
  };
  const StampedPose a{kStart, screw(0.0)};
  const StampedPose b{kStart + 1'000'000'000, screw(1.0)};
  for (const double s : {0.0, 0.1, 0.5, 0.999, 1.0})
  {
    const Pose at = interpolate(a, b, kStart + toNanoseconds(s));
    EXPECT_TRUE(at.R.isApprox(screw(s).R, 1e-12)) << s;
    EXPECT_TRUE(at.p.isApprox(screw(s).p, 1e-12)) << s;
  }
}

TEST(Association, SamplesTheReferenceBetweenItsPoses)
{
  const Trajectory reference = testing::line(101);  // 10 m/s
  Trajectory estimate = testing::line(10);
  for (StampedPose& pose : estimate.poses)
    pose.stamp_ns += 25'000'000;
  const AssociatedTrajectories t = associate(estimate, reference, {});
  ASSERT_EQ(t.reference.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i)
  {
    EXPECT_EQ(t.reference[i].stamp_ns, estimate.poses[i].stamp_ns);
    EXPECT_NEAR(t.reference[i].T_world_body.p.x(), static_cast<double>(i) + 0.25, 1e-12);
  }
  EXPECT_NEAR(t.counts.coverage, 0.9 / 10.0, 1e-12);
}

TEST(Association, NeverExtrapolates)
{
  const Trajectory estimate = testing::curve(100);
  Trajectory reference = estimate;
  reference.poses.erase(reference.poses.begin(), reference.poses.begin() + 7);
  reference.poses.erase(reference.poses.end() - 5, reference.poses.end());
  const AssociationCounts counts = associate(estimate, reference, {}).counts;
  EXPECT_EQ(counts.estimated, 100U);
  EXPECT_EQ(counts.before, 7U);
  EXPECT_EQ(counts.after, 5U);
  EXPECT_EQ(counts.in_gap, 0U);
  EXPECT_EQ(counts.used, 88U);
  EXPECT_DOUBLE_EQ(counts.coverage, 1.0);
}

TEST(Association, DoesNotBridgeGaps)
{
  const Trajectory estimate = testing::curve(100);
  Trajectory reference = estimate;
  reference.poses.erase(reference.poses.begin() + 40, reference.poses.begin() + 50);
  const AssociationCounts strict = associate(estimate, reference, {}).counts;
  EXPECT_EQ(strict.in_gap, 10U);
  EXPECT_EQ(strict.used, 90U);
  const AssociationCounts loose = associate(estimate, reference, {1.2, 0.0}).counts;
  EXPECT_EQ(loose.in_gap, 0U);
  EXPECT_EQ(loose.used, 100U);
}

TEST(Association, CoverageLeavesOutHolesOfTheEstimate)
{
  const Trajectory reference = testing::curve(101);  // 10 s
  Trajectory estimate = reference;
  estimate.poses.erase(estimate.poses.begin() + 31, estimate.poses.begin() + 70);  // 4 s
  const AssociationCounts counts = associate(estimate, reference, {}).counts;
  EXPECT_NEAR(counts.coverage, 0.6, 1e-12);
  EXPECT_NEAR(counts.longest_hole, 4.0, 1e-12);
}

TEST(Association, StepsOfKeyframesAndGapsOfTheReferenceAreNoHoles)
{
  const Trajectory reference = testing::curve(101);
  Trajectory keyframes = reference;
  keyframes.poses.clear();
  for (const std::size_t i : {0U, 10U, 25U, 60U, 80U, 100U})
    keyframes.poses.push_back(reference.poses[i]);
  const AssociationCounts counts = associate(keyframes, reference, {}).counts;
  EXPECT_DOUBLE_EQ(counts.coverage, 1.0);
  EXPECT_EQ(counts.longest_hole, 0.0);

  Trajectory with_gap = reference;
  with_gap.poses.erase(with_gap.poses.begin() + 31, with_gap.poses.begin() + 70);
  const AssociationCounts in_gap = associate(reference, with_gap, {}).counts;
  EXPECT_DOUBLE_EQ(in_gap.coverage, 1.0);
  EXPECT_EQ(in_gap.longest_hole, 0.0);
}

TEST(Association, CovariancesStayWithTheirPoses)
{
  Trajectory estimate = testing::curve(20);
  for (int i = 0; i < 20; ++i)
    estimate.covariances.emplace_back((i + 1) * Matrix6::Identity());
  Trajectory reference = testing::curve(20);
  reference.poses.erase(reference.poses.begin(), reference.poses.begin() + 5);
  const AssociatedTrajectories t = associate(estimate, reference, {});
  ASSERT_EQ(t.covariances.size(), t.estimate.size());
  EXPECT_EQ(t.covariances.front()(0, 0), 6.0);
}

TEST(Association, TimeOffsetMovesTheEstimate)
{
  Trajectory estimate = testing::curve(50);
  for (StampedPose& pose : estimate.poses)
    pose.stamp_ns -= 3'600'000'000'000;
  const AssociatedTrajectories t = associate(estimate, testing::curve(50), {0.1, 3600.0});
  EXPECT_EQ(t.counts.used, 50U);
  EXPECT_EQ(t.estimate.front().stamp_ns, kStart);
}

TEST(Association, WithoutOverlapBothRangesAreNamed)
{
  Trajectory estimate = testing::curve(50);
  for (StampedPose& pose : estimate.poses)
    pose.stamp_ns -= kStart;
  expectThrows<std::invalid_argument>(
      [&] { (void)associate(estimate, testing::curve(50), {}); },
      {"0.000000000 to 4.900000000 s", "1700000000.000000000 to 1700000004.900000000 s",
       "50 are before", "clock"});
}

TEST(Association, BadOptionsAndTrajectories)
{
  const Trajectory t = testing::curve(5);
  const auto with = [&](AssociationOptions options)
  { return [&t, options] { (void)associate(t, t, options); }; };
  expectThrows<std::invalid_argument>(with({0.0, 0.0}), {"gap"});
  expectThrows<std::invalid_argument>(with({std::nan(""), 0.0}), {"gap"});
  expectThrows<std::invalid_argument>(
      with({0.1, std::numeric_limits<double>::infinity()}), {"offset"});
  expectThrows<std::invalid_argument>([&] { (void)associate(t, {}, {}); }, {"no pose"});
}

}  // namespace
}  // namespace fastlio
