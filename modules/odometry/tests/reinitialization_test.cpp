// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "reinitialization.h"

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
constexpr std::int64_t kSecond = 1'000'000'000;

double carriedStd(std::int64_t start_ns)
{
  Reinitialization reinitialization{OdometryOptions{}};
  FilterState state;
  state.x.v = {4.0, 0.0, 0.0};
  const std::string why = reinitialization.decideAt({10 * kSecond, 11 * kSecond, false}, state);
  EXPECT_NE(why.find("1.00 s without inertial samples"), std::string::npos) << why;
  EXPECT_TRUE(reinitialization.pending());
  const CarriedPose carried = reinitialization.takeCarried(start_ns);
  EXPECT_FALSE(reinitialization.pending());
  return std::sqrt(carried.P(kPosition, kPosition));
}

// The gap took one second, but scans and inertial data made no start for three more.
TEST(Reinitialization, TheCarriedPoseIsAsUncertainAsTheTimeUntilTheStart)
{
  EXPECT_NEAR(carriedStd(11 * kSecond), 0.5, 1e-6);
  EXPECT_NEAR(carriedStd(14 * kSecond), 8.0, 1e-6);
}

/** A scan of which nothing or everything matches. */
ScanResult scanThat(bool matches, std::int64_t stamp_ns)
{
  constexpr std::size_t kPoints = 1000;
  ScanResult result;
  result.status = matches ? ScanStatus::Tracking : ScanStatus::Diverged;
  result.stamp_ns = stamp_ns;
  result.statistics.points_downsampled = kPoints;
  result.statistics.points_effective = matches ? kPoints : 0;
  return result;
}

// Gaps are as long as nobody knew the pose: neither the inertial data nor a scan.
TEST(Reinitialization, AGapThatScansFollowThroughIsNoBreak)
{
  constexpr std::int64_t kTenth = kSecond / 10;
  Reinitialization reinitialization{OdometryOptions{}};
  reinitialization.addBreak({100 * kTenth, 112 * kTenth, false});
  const auto breaks = [&](std::int64_t end_ns)
  { return reinitialization.breakBefore(end_ns).has_value(); };
  const auto match = [&](std::int64_t stamp_ns) {
    EXPECT_FALSE(reinitialization.detectTrackingLoss(scanThat(true, stamp_ns), {}, false, false));
  };
  EXPECT_FALSE(breaks(105 * kTenth));
  EXPECT_TRUE(breaks(106 * kTenth));
  match(104 * kTenth);
  EXPECT_FALSE(breaks(109 * kTenth));
  EXPECT_TRUE(breaks(110 * kTenth));
  match(108 * kTenth);
  EXPECT_FALSE(breaks(112 * kTenth)) << "0.4 s are left, which are bridged";
  EXPECT_FALSE(breaks(120 * kTenth)) << "the gap is over";
}

TEST(Reinitialization, AfterAGapTheRunGoesOnFromTheLastScanThatMatched)
{
  Reinitialization reinitialization{OdometryOptions{}};
  FilterState followed;
  followed.x.p = {1.0, 0.0, 0.0};
  EXPECT_FALSE(
      reinitialization.detectTrackingLoss(scanThat(true, 11 * kSecond), followed, false, false));
  EXPECT_FALSE(
      reinitialization.decideAt({10 * kSecond, 13 * kSecond, false}, FilterState{}).empty());
  const CarriedPose carried = reinitialization.takeCarried(12 * kSecond);
  EXPECT_EQ(carried.x.p, followed.x.p);
  EXPECT_NEAR(std::sqrt(carried.P(kPosition, kPosition)), 0.5, 1e-6) << "unknown for a second";
}

/** Scans that do not match until the pose counts as lost. */
void lose(Reinitialization& reinitialization, std::int64_t from_ns)
{
  const FilterState state;
  EXPECT_FALSE(reinitialization.detectTrackingLoss(scanThat(false, from_ns), state, false, false));
  EXPECT_TRUE(
      reinitialization.detectTrackingLoss(scanThat(false, from_ns + kSecond), state, false, false));
}

TEST(Reinitialization, AStateThatIsKnownGoesOnOnceUntilAScanMatches)
{
  Reinitialization reinitialization{OdometryOptions{}};
  lose(reinitialization, 10 * kSecond);
  EXPECT_TRUE(reinitialization.goesOn(true));
  EXPECT_FALSE(reinitialization.pending());
  lose(reinitialization, 20 * kSecond);
  EXPECT_FALSE(reinitialization.goesOn(true)) << "the state may be the reason";
  EXPECT_TRUE(reinitialization.pending());
  EXPECT_FALSE(reinitialization.detectTrackingLoss(scanThat(true, 30 * kSecond), {}, false, false));
  lose(reinitialization, 40 * kSecond);
  EXPECT_TRUE(reinitialization.goesOn(true));
}

TEST(Reinitialization, AStateThatIsNotKnownDoesNotGoOn)
{
  Reinitialization reinitialization{OdometryOptions{}};
  lose(reinitialization, 10 * kSecond);
  EXPECT_FALSE(reinitialization.goesOn(false));
  EXPECT_TRUE(reinitialization.pending());
}
}  // namespace
}  // namespace fastlio
