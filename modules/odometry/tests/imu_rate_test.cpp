// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The states between scans: their stamps, how they continue each other, accuracy, causality.

#include "odometry_runs.h"
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
const RoomRecording& roomForImuRate()
{
  static const RoomRecording recording = recordRoom(5.0);
  return recording;
}

OdometryOptions imuRateParameters(int threads = 1)
{
  OdometryOptions p = roomParameters();
  p.imu_rate = true;
  p.threads = threads;
  return p;
}

/** A scan's result and the states on the way to it. */
struct Step
{
  ScanResult result;
  std::vector<ImuRateState> before;
};

std::vector<Step> stepsOf(Odometry& odometry, const RoomRecording& recording)
{
  std::vector<Step> steps;
  for (const ImuSample& sample : recording.imu)
    odometry.addImu(sample);
  for (const LidarScan& scan : recording.scans)
  {
    odometry.addScan(scan);
    while (auto result = odometry.next())
      steps.push_back({std::move(*result), odometry.imuRateStates()});
  }
  return steps;
}

std::vector<Step> stepsOf(const OdometryOptions& parameters, const RoomRecording& recording)
{
  Odometry odometry(parameters);
  return stepsOf(odometry, recording);
}

bool sameBits(const ImuRateState& a, const ImuRateState& b)
{
  return a.stamp_ns == b.stamp_ns && a.x.R == b.x.R && a.x.p == b.x.p && a.x.v == b.x.v &&
         a.angular_rate == b.angular_rate && a.pose_covariance == b.pose_covariance;
}
}  // namespace

TEST(ImuRate, CostsNothingWhenItIsNotAskedFor)
{
  Odometry odometry(roomParameters());
  for (const Step& step : stepsOf(odometry, roomForImuRate()))
    EXPECT_TRUE(step.before.empty());
  EXPECT_EQ(odometry.imuRateStates().capacity(), 0U);
}

TEST(ImuRate, ItsStampsAreThoseOfTheSamplesEachOnce)
{
  std::vector<std::int64_t> stamps;
  const auto steps = stepsOf(imuRateParameters(), roomForImuRate());
  for (const Step& step : steps)
    for (const ImuRateState& state : step.before)
      stamps.push_back(state.stamp_ns);
  std::vector<std::int64_t> expected;
  for (const ImuSample& sample : roomForImuRate().imu)
    if (sample.stamp_ns > steps.front().result.begin_ns &&
        sample.stamp_ns <= steps.back().result.stamp_ns)
      expected.push_back(sample.stamp_ns);
  EXPECT_EQ(stamps, expected);
}

TEST(ImuRate, EachStateContinuesTheOneBefore)
{
  // What a wrong calibration does to the pose may become less on the way back.
  OdometryOptions calibrated = imuRateParameters();
  calibrated.calibration.extrinsic_rotation_std = 0.0;
  calibrated.calibration.extrinsic_translation_std = 0.0;
  calibrated.calibration.imu_scale_std = calibrated.calibration.imu_misalignment_std = 0.0;
  for (const Step& step : stepsOf(calibrated, roomForImuRate()))
    for (std::size_t i = 1; i < step.before.size(); ++i)
    {
      const ImuRateState &a = step.before[i - 1], &b = step.before[i];
      const double dt = toSeconds(b.stamp_ns - a.stamp_ns);
      EXPECT_LT((b.x.p - a.x.p - dt * a.x.v).norm(), 1e-3);
      EXPECT_LT((b.x.v - a.x.v).norm(), 0.1);
      EXPECT_LT((logSO3(a.x.R.transpose() * b.x.R) - dt * a.angular_rate).norm(), 1e-3);
      EXPECT_GE(b.pose_covariance.trace(), a.pose_covariance.trace() * (1.0 - 1e-9));
    }
}

TEST(ImuRate, TheLastStateOfAScanIsNearWhatTheScanSaid)
{
  const auto steps = stepsOf(imuRateParameters(), roomForImuRate());
  for (std::size_t k = 5; k < steps.size(); ++k)
  {
    ASSERT_FALSE(steps[k].before.empty());
    const ImuRateState& last = steps[k].before.back();
    const NavState& x = steps[k].result.filter.x;
    const double dt = toSeconds(steps[k].result.stamp_ns - last.stamp_ns);
    EXPECT_LT(dt, 0.006);
    EXPECT_LT((last.x.p + dt * last.x.v - x.p).norm(), 0.01);
    EXPECT_LT(logSO3(last.x.R.transpose() * x.R).norm(), 0.02);
  }
}

TEST(ImuRate, IsAsGoodAsTheScansAndItsCovarianceHoldsTheError)
{
  const auto steps = stepsOf(imuRateParameters(), roomForImuRate());
  const Pose T_world_truth = steps.front().result.filter.x.pose() *
                             roomForImuRate().truthAt(steps.front().result.stamp_ns).inverse();
  for (std::size_t k = 1; k < steps.size(); ++k)
    for (const ImuRateState& state : steps[k].before)
    {
      const Pose truth = T_world_truth * roomForImuRate().truthAt(state.stamp_ns);
      const double error = (state.x.p - truth.p).norm();
      EXPECT_LT(error, 0.01);
      EXPECT_LT(error, 4.0 * std::sqrt(state.pose_covariance.bottomRightCorner<3, 3>().trace()));
      EXPECT_LT(logSO3(truth.R.transpose() * state.x.R).norm(), 0.003);
    }
}

TEST(ImuRate, ThreadsChangeNoBit)
{
  const auto one = stepsOf(imuRateParameters(1), roomForImuRate()),
             two = stepsOf(imuRateParameters(2), roomForImuRate());
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t k = 0; k < one.size(); ++k)
  {
    const auto &a = one[k].before, &b = two[k].before;
    EXPECT_TRUE(std::equal(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const ImuRateState& s, const ImuRateState& t) { return sameBits(s, t); }));
  }
}

// A program that follows the sensor gets the same states as a program that reads them afterwards.
TEST(ImuRate, IsWhatWasKnownAtEachSample)
{
  Odometry odometry(imuRateParameters());
  std::vector<ImuRateState> live, afterwards;
  std::size_t next_sample = 0;
  EXPECT_FALSE(odometry.stateAtNewestSample());
  for (const LidarScan& scan : roomForImuRate().scans)
  {
    const std::int64_t end_ns = spanOf(scan).end_ns;
    for (; next_sample < roomForImuRate().imu.size() &&
           roomForImuRate().imu[next_sample].stamp_ns <= end_ns;
         ++next_sample)
    {
      odometry.addImu(roomForImuRate().imu[next_sample]);
      if (const auto state = odometry.stateAtNewestSample()) live.push_back(*state);
    }
    odometry.addScan(scan);
    while (odometry.flush())  // the scan's end lies a little behind the newest sample
      afterwards.insert(
          afterwards.end(), odometry.imuRateStates().begin(), odometry.imuRateStates().end());
  }
  ASSERT_GT(live.size(), 500U);
  ASSERT_GE(afterwards.size(), live.size());
  afterwards.erase(afterwards.begin(), afterwards.end() - static_cast<std::ptrdiff_t>(live.size()));
  for (std::size_t i = 0; i < live.size(); ++i)
    EXPECT_TRUE(sameBits(live[i], afterwards[i])) << i;
}

TEST(ImuRate, StopsWhereThePoseIsNotTrusted)
{
  RoomRecording absurd = roomForImuRate();
  for (ImuSample& sample : absurd.imu)
    if (sample.stamp_ns > kRecordingStart + 3'000'000'000) sample.accel = Vec3::Constant(5e5);
  OdometryOptions p = imuRateParameters();
  p.measurement.max_unaided_time = 0.3;
  p.recovery.enabled = false;
  const auto steps = stepsOf(p, absurd);
  ASSERT_EQ(steps.back().result.status, ScanStatus::Diverged);
  EXPECT_TRUE(steps.back().before.empty());
  for (const Step& step : steps)
    for (const ImuRateState& state : step.before)
      EXPECT_TRUE(isFinite(state.x));
}
