// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Inertial samples are missing for seconds, scans are not: the scans show the way through the gap.

#include "odometry_runs.h"
#include "rate_in_gap.h"
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fastlio::testing
{
namespace
{
constexpr double kGapBegin = 4.5;  // [s], in motion

RoomRecording roomWithoutImuFor(double seconds)
{
  RoomSettings settings;
  settings.duration = 12.0;
  RoomRecording recording = recordRoom(settings);
  const auto is_missing = [&](const ImuSample& sample)
  {
    const double t = toSeconds(sample.stamp_ns - kRecordingStart);
    return t > kGapBegin && t < kGapBegin + seconds;
  };
  recording.imu.erase(
      std::remove_if(recording.imu.begin(), recording.imu.end(), is_missing), recording.imu.end());
  return recording;
}

TEST(RateInGap, ChangesAsExpectedUntilScansShowHowMuch)
{
  RateInGap rate;
  EXPECT_EQ(rate.changeStd(0.2), 0.2);
  for (int i = 0; i < 50; ++i)
    rate.add(Vec3(1.0, -1.0, 1.0));
  EXPECT_NEAR(rate.changeStd(0.2), 1.0, 0.02);
  EXPECT_EQ(rate.correction(), Vec3::Zero());
  rate.correct({0.1, 0.0, 0.0});
  rate.correct({0.1, 0.2, 0.0});
  EXPECT_TRUE(rate.correction().isApprox(Vec3(0.2, 0.2, 0.0)));
}

class ScansFollowThroughAGap : public ::testing::TestWithParam<double>
{
};

TEST_P(ScansFollowThroughAGap, InTheMapOfBefore)
{
  const RoomRecording recording = roomWithoutImuFor(GetParam());
  OdometryOptions parameters = roomParameters(recording.settings);
  Odometry odometry(parameters);
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(results.size(), recording.scans.size());
  EXPECT_TRUE(odometry.diagnostics().empty()) << odometry.diagnostics().front().text;
  EXPECT_EQ(countOf(results, ScanStatus::Diverged), 0U);
  EXPECT_EQ(countOf(results, ScanStatus::FirstScan), 1U);
  std::size_t in_gap = 0, matched = 0;
  for (const ScanResult& r : results)
  {
    const double t = toSeconds(r.stamp_ns - kRecordingStart);
    const Vec3 error = r.filter.x.p - recording.truthAt(r.stamp_ns).p;
    const double std = std::sqrt(r.filter.P.block<3, 3>(kPosition, kPosition).trace());
    if (t > kGapBegin + 0.1 && t < kGapBegin + GetParam())
    {
      ++in_gap;
      matched += r.status == ScanStatus::Tracking ? 1 : 0;
      EXPECT_LT(r.health.value, 0.5) << "it says that inertial data are missing";
      EXPECT_LT(error.norm(), 0.2) << t;
      EXPECT_LT(error.norm(), 4.0 * std) << t;
      const Mat3 attitude = r.filter.P.block<3, 3>(kAttitude, kAttitude);
      const Vec3 turned = logSO3(r.filter.x.R.transpose() * recording.truthAt(r.stamp_ns).R);
      EXPECT_LT(turned.norm(), 4.0 * std::sqrt(attitude.trace())) << t;
    }
    const bool after = t > kGapBegin + GetParam() + 0.5;
    EXPECT_TRUE(!after || error.norm() < 0.03) << t;
  }
  EXPECT_GT(in_gap, 0U);
  EXPECT_GT(10 * matched, 9 * in_gap);
}

INSTANTIATE_TEST_SUITE_P(
    Seconds, ScansFollowThroughAGap, ::testing::Values(1.0, 2.5, 5.0),
    [](const auto& parameter) { return std::to_string(int(10.0 * parameter.param)) + "00ms"; });
}  // namespace
}  // namespace fastlio::testing
