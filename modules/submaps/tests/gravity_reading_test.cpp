// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Gravity by the accelerometer on a platform that turns, speeds up, and has a bias.

#include <fastlio/math/so3.h>
#include <fastlio/math/time.h>
#include <fastlio/submaps/gravity_reading.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kPull = 9.81;
const Vec3 kSensorBias(0.05, -0.08, 0.02);  // [m/s^2]

struct Platform
{
  /** Turns about the vertical, on a slope, and swings ahead. */
  static Mat3 attitude(double t) { return expSO3({0, 0, 0.3 * t}) * expSO3({0.05, -0.1, 0}); }
  static Vec3 position(double t) { return {-1.5 * std::cos(1.4 * t), 0.25 * t * t, 0.0}; }
  static Vec3 acceleration(double t) { return {2.94 * std::cos(1.4 * t), 0.5, 0.0}; }

  static ImuSample sample(double t)
  {
    ImuSample s;
    s.stamp_ns = toNanoseconds(100.0 + t);
    s.accel = attitude(t).transpose() * (acceleration(t) + Vec3(0, 0, kPull)) + kSensorBias;
    return s;
  }

  static ScanResult scan(double t)
  {
    ScanResult result;
    result.status = ScanStatus::Tracking;
    result.stamp_ns = toNanoseconds(100.0 + t);
    result.filter.x.R = attitude(t);
    result.filter.x.p = position(t);
    result.filter.x.g = {0, 0, -kPull};
    return result;
  }
};

/** Samples every 5 ms, scans every 100 ms, from \a begin to \a end [s]. */
void feed(GravityMeter& meter, int begin_ms, int end_ms, int missing_ms = -1)
{
  for (int ms = begin_ms; ms < end_ms; ms += 5)
  {
    if (missing_ms < 0 || ms < missing_ms || ms > missing_ms + 200)
      meter.addImu(Platform::sample(1e-3 * ms));
    if (ms % 100 == 0) meter.addScan(Platform::scan(1e-3 * ms));
  }
}
}  // namespace

TEST(GravityMeter, LeavesGravityAndTheBias)
{
  GravityMeter meter;
  feed(meter, 0, 1001);
  EXPECT_FALSE(meter.take());  // two stretches are needed
  feed(meter, 1005, 3001);
  const auto reading = meter.take();
  ASSERT_TRUE(reading);
  const Vec3 gravity = Platform::attitude(1.0).transpose() * Vec3(0, 0, kPull);
  EXPECT_LT((reading->force - reading->by_bias * kSensorBias - gravity).norm(), 0.02);
  EXPECT_GT((reading->force - gravity).norm(), 0.06);
}

TEST(GravityMeter, TellsNothingWhereSamplesAreMissing)
{
  GravityMeter meter;
  feed(meter, 0, 1001);
  (void)meter.take();
  feed(meter, 1005, 2001, 1300);
  EXPECT_FALSE(meter.take());
  feed(meter, 2005, 3001);
  EXPECT_FALSE(meter.take());
  feed(meter, 3005, 4001);
  EXPECT_TRUE(meter.take());
}

/** While the LiDAR is silent, the attitude may do anything: a hump looks like level ground. */
TEST(GravityMeter, TellsNothingAcrossATimeWithoutPoses)
{
  GravityMeter meter;
  feed(meter, 0, 1001);
  (void)meter.take();
  for (int ms = 1005; ms < 3000; ms += 5)
    meter.addImu(Platform::sample(1e-3 * ms));
  feed(meter, 3000, 4001);
  EXPECT_FALSE(meter.take());
  feed(meter, 4005, 5001);
  const auto reading = meter.take();
  ASSERT_TRUE(reading);
  const Vec3 gravity = Platform::attitude(4.0).transpose() * Vec3(0, 0, kPull);
  EXPECT_LT((reading->force - reading->by_bias * kSensorBias - gravity).norm(), 0.02);
}

/** A run that waits for its start, or has lost its pose, for hours. */
TEST(GravityMeter, KeepsNoSamplesWhileThereAreNoPoses)
{
  GravityMeter meter;
  const auto mostWithoutPose = [&meter](int begin_ms, int end_ms)
  {
    std::size_t most = 0;
    for (int ms = begin_ms; ms < end_ms; ms += 5)
    {
      meter.addImu(Platform::sample(1e-3 * ms));
      ScanResult scan = Platform::scan(1e-3 * ms);
      scan.status = begin_ms == 0 ? ScanStatus::Initializing : ScanStatus::Diverged;
      if (ms % 100 == 0) meter.addScan(scan);
      most = std::max(most, meter.waitingSamples());
    }
    return most;
  };
  EXPECT_LE(mostWithoutPose(0, 5000), 20U);
  feed(meter, 5000, 6001);
  EXPECT_LE(mostWithoutPose(6005, 20000), 130U);
  EXPECT_LE(meter.waitingSamples(), 20U);
  feed(meter, 20000, 21001);
  EXPECT_FALSE(meter.take());
  feed(meter, 21005, 22001);
  EXPECT_TRUE(meter.take());
}

TEST(GravityMeter, TellsNothingOfAShortTimeOrAnotherForce)
{
  GravityMeter meter;
  EXPECT_FALSE(meter.take());
  feed(meter, 0, 1001);
  (void)meter.take();
  feed(meter, 1005, 1301);
  EXPECT_FALSE(meter.take());
  for (int round = 0; round < 2; ++round)
  {
    for (int ms = 1305 + 1000 * round; ms < 2301 + 1000 * round; ms += 5)
    {
      ImuSample sample = Platform::sample(1e-3 * ms);
      sample.accel /= kPull;  // a recording in units of g
      meter.addImu(sample);
      if (ms % 100 == 0) meter.addScan(Platform::scan(1e-3 * ms));
    }
    EXPECT_FALSE(meter.take());
  }
}

/** Where the odometry is lost, its positions tell no velocity. */
TEST(GravityMeter, TellsNothingOfUncertainPositions)
{
  GravityMeter meter;
  for (int round = 0; round < 3; ++round)
  {
    for (int ms = 1000 * round; ms < 1000 * (round + 1); ms += 5)
    {
      meter.addImu(Platform::sample(1e-3 * ms));
      ScanResult scan = Platform::scan(1e-3 * ms);
      scan.filter.P.block<3, 3>(kPosition, kPosition) = 100.0 * Mat3::Identity();
      if (ms % 100 == 0) meter.addScan(scan);
    }
    EXPECT_FALSE(meter.take()) << round;
  }
}

}  // namespace fastlio
