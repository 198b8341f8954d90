// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "conditioned_samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace fastlio::testing
{
namespace
{
std::size_t inflations(const Conditioned& c, InertialFault fault)
{
  std::size_t n = 0;
  for (const ConditionedSample& s : c.samples)
    n += s.inflation && s.inflation->fault == fault ? 1 : 0;
  return n;
}
}  // namespace

TEST(ImuConditioner, CleanSamplesComeOutAsTheyCameIn)
{
  const auto raw = tilting(1000);
  const Conditioned c = conditioned(raw);
  ASSERT_EQ(c.samples.size(), raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i)
  {
    ASSERT_EQ(c.samples[i].sample.stamp_ns, raw[i].stamp_ns);
    ASSERT_EQ(c.samples[i].sample.gyro, raw[i].gyro);
    ASSERT_EQ(c.samples[i].sample.accel, raw[i].accel);
    ASSERT_FALSE(c.samples[i].inflation || c.samples[i].after_break);
  }
  EXPECT_EQ(c.report.accel_unit, AccelUnit::Si);
  EXPECT_EQ(c.report.gyro_unit, GyroUnit::Radians);
  EXPECT_NEAR(c.report.rate, 200.0, 1e-6);
  EXPECT_LT(c.report.jitter, 1e-6);
  EXPECT_EQ(c.diagnostics, "");
}

TEST(ImuConditioner, ALoneSpikeIsLeftOutAndItsTimeIsNoiseInflated)
{
  auto raw = tilting(400);
  raw[200].gyro = Vec3(30.0, -40.0, 5.0);
  raw[300].accel = Vec3(1e5, 0.0, 0.0);
  raw[350].accel.x() = 1e30;
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.report.spikes, 3U);
  EXPECT_EQ(c.samples.size(), raw.size() - 3);
  EXPECT_EQ(inflations(c, InertialFault::Spike), 3U);
  for (const ConditionedSample& s : c.samples)
    ASSERT_LT(s.sample.gyro.norm() + s.sample.accel.norm(), 12.0);
}

TEST(ImuConditioner, ReadingsThatRepeatAreNamedOnceEachTime)
{
  auto raw = tilting(1000);
  for (std::size_t i = 200; i < 500; ++i)  // 1.5 s
    raw[i].gyro = raw[200].gyro, raw[i].accel = raw[200].accel;
  for (std::size_t i = 700; i < 790; ++i)  // 0.45 s: a busy host
    raw[i].gyro = raw[700].gyro, raw[i].accel = raw[700].accel;
  const std::string text = conditioned(raw).diagnostics;
  const std::size_t at = text.find("the inertial readings repeat: all six values are the same");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_EQ(text.find("the inertial readings repeat", at + 1), std::string::npos) << text;
}

TEST(ImuConditioner, AStepThatStaysIsNoSpike)
{
  auto raw = tilting(400);
  for (std::size_t i = 200; i < raw.size(); ++i)
    raw[i].gyro.x() += 15.0;
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.report.spikes, 0U);
  EXPECT_EQ(c.samples.size(), raw.size());
}

TEST(ImuConditioner, ClippedSamplesAreFoundWithoutKnowingTheRange)
{
  auto raw = tilting(1000);
  std::size_t clipped = 0;
  for (ImuSample& s : raw)
  {
    s.gyro.x() *= 4.0;
    if (std::abs(s.gyro.x()) > 3.5) ++clipped;
    s.gyro.x() = std::min(3.5, std::max(-3.5, s.gyro.x()));
  }
  ImuOptions p;
  p.gyro_unit = GyroUnit::Radians;
  const Conditioned c = conditioned(raw, p);
  EXPECT_GT(clipped, 100U);
  EXPECT_GT(c.report.saturated, clipped * 9 / 10);
  EXPECT_LE(c.report.saturated, clipped);
  for (const ConditionedSample& s : c.samples)
    ASSERT_TRUE(!s.inflation || std::abs(s.inflation->gyro_std - 0.5 * 3.5) < 1e-9);
}

TEST(ImuConditioner, AKnownRangeTellsTheFirstClippedSample)
{
  ImuOptions p;
  p.accel_range = 20.0;
  auto raw = tilting(100);
  raw[50].accel.z() = 20.0;
  const Conditioned c = conditioned(raw, p);
  EXPECT_EQ(c.report.saturated, 1U);
  EXPECT_EQ(inflations(c, InertialFault::Saturation), 2U);  // inputs on both sides
}

TEST(ImuConditioner, GapsInflateNoiseAndLongOnesBreakTheRun)
{
  auto raw = tilting(1000);
  raw.erase(raw.begin() + 700, raw.begin() + 900);  // 1 s
  raw.erase(raw.begin() + 100, raw.begin() + 110);  // 50 ms
  const Conditioned c = conditioned(raw);
  ASSERT_EQ(c.samples.size(), raw.size());
  EXPECT_EQ(c.report.gaps, 2U);
  EXPECT_EQ(c.report.missing, 10U) << "a break is no loss of samples";
  EXPECT_NEAR(c.report.longest_gap, 1.005, 1e-9);
  EXPECT_EQ(inflations(c, InertialFault::Gap), 2U);
  EXPECT_TRUE(c.samples[100].inflation && !c.samples[100].after_break);
  EXPECT_TRUE(c.samples[690].inflation && c.samples[690].after_break);
  // 30 deg/s and 2 m/s^2 in a gap of imu.max_gap, as long as the motion is hardly known.
  const double gyro_std = M_PI / 6.0 * 0.055 / ImuOptions{}.max_gap;
  EXPECT_NEAR(c.samples[100].inflation->gyro_std, gyro_std, 1e-9);
  EXPECT_DOUBLE_EQ(c.samples[690].inflation->accel_std, 2.0);
}

TEST(ImuConditioner, ABreakStaysOneWhenTheFirstSampleBehindItIsImpossible)
{
  auto raw = tilting(1000);
  raw.erase(raw.begin() + 700, raw.begin() + 900);  // 1 s
  raw[700].accel = Vec3(1e7, 0.0, 0.0);
  const Conditioned c = conditioned(raw);
  ASSERT_EQ(c.samples.size(), raw.size() - 1);
  EXPECT_TRUE(c.samples[700].after_break);
  EXPECT_EQ(c.report.missing, 0U);
}

TEST(ImuConditioner, AGapCostsWhatTheMotionBeforeItShows)
{
  auto raw = tilting(1000);
  raw.erase(raw.begin() + 700, raw.begin() + 740);
  const Conditioned calm = conditioned(raw);
  for (ImuSample& sample : raw)
    sample.gyro.x() += 4.0 * std::sin(toSeconds(sample.stamp_ns - kStart) * 20.0);
  const Conditioned shaken = conditioned(raw);
  ASSERT_TRUE(calm.samples[700].inflation && shaken.samples[700].inflation);
  // The tilt changes by 2 rad/s^2 and less; a tenth of 30 deg/s times 0.205 s / imu.max_gap.
  const double least = M_PI / 60.0 * 0.205 / ImuOptions{}.max_gap;
  EXPECT_DOUBLE_EQ(calm.samples[700].inflation->gyro_std, least);
  EXPECT_GT(shaken.samples[700].inflation->gyro_std, 1.0);
}

TEST(ImuConditioner, WrongStampsAreLeftOut)
{
  auto raw = tilting(1000);
  raw[0].stamp_ns += 3'600'000'000'000;  // also of the very first sample
  raw[400].stamp_ns += 86'400'000'000'000;
  raw[401].stamp_ns = 12345;
  raw[500].stamp_ns = -7;
  raw[600].stamp_ns = std::numeric_limits<std::int64_t>::max();
  raw[700].stamp_ns = std::numeric_limits<std::int64_t>::min();
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.report.bad_stamps + c.report.late, 6U);
  EXPECT_EQ(c.samples.size(), raw.size() - 6);
  for (const ConditionedSample& s : c.samples)
    ASSERT_FALSE(s.after_break);
}

TEST(ImuConditioner, AClockThatIsSetBackGoesOn)
{
  auto raw = tilting(1000);
  for (std::size_t i = 500; i < raw.size(); ++i)
    raw[i].stamp_ns -= 3'600'000'000'000;
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.report.clock_steps, 1U);
  EXPECT_NE(c.diagnostics.find("set back"), std::string::npos) << c.diagnostics;
  ASSERT_EQ(c.samples.size(), raw.size());
  for (std::size_t i = 1; i < raw.size(); ++i)
    ASSERT_EQ(c.samples[i].sample.stamp_ns - c.samples[i - 1].sample.stamp_ns, kPeriod) << i;
}
}  // namespace fastlio::testing
