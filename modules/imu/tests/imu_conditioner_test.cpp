// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriod = 5'000'000;
constexpr double kDown = 9.81;

/** A platform that tilts to and fro by 30 deg, with a known rate. */
std::vector<ImuSample> tilting(int count)
{
  std::vector<ImuSample> samples;
  for (int i = 0; i < count; ++i)
  {
    const double t = toSeconds(i * kPeriod);
    const double angle = 0.5 * std::sin(2.0 * t), rate = std::cos(2.0 * t);
    samples.push_back(
        {kStart + i * kPeriod, Vec3(rate, 0.001, -0.002),
         kDown * Vec3(0.0, std::sin(angle), std::cos(angle))});
  }
  return samples;
}

struct Conditioned
{
  std::vector<ConditionedSample> samples;
  ImuReport report;
  std::string diagnostics;
};

Conditioned conditioned(const std::vector<ImuSample>& raw, const ImuOptions& p = {})
{
  ImuConditioner conditioner(p, kDown);
  Conditioned result;
  const auto append = [&](const std::vector<ConditionedSample>& ready)
  { result.samples.insert(result.samples.end(), ready.begin(), ready.end()); };
  for (const ImuSample& sample : raw)
    append(conditioner.add(sample));
  append(conditioner.finish());
  result.report = conditioner.report();
  for (const Diagnostic& diagnostic : conditioner.takeDiagnostics())
    result.diagnostics += diagnostic.text + "\n";
  return result;
}

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

class AccelUnits : public ::testing::TestWithParam<AccelUnit>
{
};

TEST_P(AccelUnits, AreFoundFromTheMagnitude)
{
  const auto si = tilting(300);
  auto raw = si;
  for (ImuSample& s : raw)
    s.accel /= siPerUnit(GetParam());
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.report.accel_unit, GetParam());
  EXPECT_EQ(c.diagnostics.empty(), GetParam() == AccelUnit::Si) << c.diagnostics;
  ASSERT_EQ(c.samples.size(), si.size());
  for (std::size_t i = 0; i < si.size(); ++i)
    ASSERT_LT((c.samples[i].sample.accel - si[i].accel).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Unit, AccelUnits, ::testing::Values(AccelUnit::Si, AccelUnit::G, AccelUnit::MilliG));

TEST(ImuConditioner, AnUnknownUnitIsReportedAndLeftAlone)
{
  auto raw = tilting(100);
  for (ImuSample& s : raw)
    s.accel *= 0.02;  // gravity removed, as it were
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.samples.front().sample.accel, raw.front().accel);
  EXPECT_NE(c.diagnostics.find("no known unit"), std::string::npos) << c.diagnostics;
}

TEST(ImuConditioner, AUnitThatIsGivenIsUsedFromTheFirstSample)
{
  ImuOptions p;
  p.accel_unit = AccelUnit::G;
  p.gyro_unit = GyroUnit::Degrees;
  p.invert_acceleration = true;
  ImuConditioner conditioner(p, kDown);
  (void)conditioner.add({kStart, Vec3(0, 0, 0), Vec3(0, 0, -1)});
  const auto& ready = conditioner.add({kStart + kPeriod, Vec3(0, 0, 180), Vec3(0, 0, -1)});
  ASSERT_EQ(ready.size(), 2U);
  EXPECT_NEAR(ready[1].sample.gyro.z(), M_PI, 1e-12);
  EXPECT_NEAR(ready[1].sample.accel.z(), 9.80665, 1e-12);
}

TEST(ImuConditioner, DegreesPerSecondAreFoundWhenGravityTurns)
{
  auto raw = tilting(2000);
  for (ImuSample& s : raw)
    s.gyro *= 180.0 / M_PI;
  const Conditioned c = conditioned(raw);
  EXPECT_EQ(c.report.gyro_unit, GyroUnit::Degrees);
  EXPECT_NE(c.diagnostics.find("deg/s"), std::string::npos) << c.diagnostics;
  std::size_t flips = 0;
  bool flipped = false;
  for (const ConditionedSample& s : c.samples)
  {
    flips += s.rescale_gyro != 1.0 ? 1 : 0;
    flipped = flipped || s.rescale_gyro != 1.0;
    ASSERT_TRUE(!flipped || s.sample.gyro.norm() < 1.01);
  }
  EXPECT_EQ(flips, 1U);
}

// Samples that wait for their successor, as steps in deg/s are larger than any in rad/s, are in
// that unit too.
TEST(ImuConditioner, NoSampleStaysInDegreesPerSecond)
{
  constexpr double kMost = 11.0;  // [rad/s]
  std::vector<ImuSample> raw;
  for (int i = 0; i < 4000; ++i)
  {
    const std::int64_t since_ns = i * kPeriod / 2;
    const double t = toSeconds(since_ns), turn = 2.0 * M_PI * 2.5;
    const double angle = 40.0 * M_PI / 180.0 * std::sin(turn * t);
    const double rate = 40.0 * turn * std::cos(turn * t);  // [deg/s]
    raw.push_back(
        {kStart + since_ns, Vec3(rate, 0.0, 0.0),
         kDown * Vec3(0.0, std::sin(angle), std::cos(angle))});
  }
  const Conditioned c = conditioned(raw);
  ASSERT_EQ(c.report.gyro_unit, GyroUnit::Degrees);
  ASSERT_EQ(c.samples.size(), raw.size());
  bool flipped = false;
  for (const ConditionedSample& s : c.samples)
  {
    flipped = flipped || s.rescale_gyro != 1.0;
    ASSERT_TRUE(!flipped || s.sample.gyro.norm() < kMost) << s.sample.gyro.norm();
  }
}

// A spin that lasts until the end of a window of the other test.
TEST(ImuConditioner, ASpinThatIsNoneInRadiansStaysFound)
{
  for (int last = 495; last < 560; ++last)
  {
    std::vector<ImuSample> raw;
    for (int i = 0; i < 1000; ++i)
      raw.push_back(
          {kStart + i * kPeriod, Vec3(0, 0, i >= 400 && i <= last ? 40.0 : 0.1),
           Vec3(0, 0, kDown)});
    const bool is_long = last - 400 > 100;  // 0.5 s
    const GyroUnit unit = conditioned(raw).report.gyro_unit;
    EXPECT_TRUE(!is_long || unit == GyroUnit::Degrees) << last;
  }
}

TEST(ImuConditioner, DegreesPerSecondAreFoundOfAPlatformThatOnlyYaws)
{
  std::vector<ImuSample> raw;
  for (int i = 0; i < 1000; ++i)
    raw.push_back({kStart + i * kPeriod, Vec3(0, 0, i < 400 ? 0.1 : 40.0), Vec3(0, 0, kDown)});
  EXPECT_EQ(conditioned(raw).report.gyro_unit, GyroUnit::Degrees);
}

TEST(ImuConditioner, FastTurnsInRadiansStayRadians)
{
  std::vector<ImuSample> raw;  // 6 rad/s about a level axis, with strong accelerations
  for (int i = 0; i < 2000; ++i)
  {
    const double t = toSeconds(i * kPeriod), angle = 6.0 * t;
    raw.push_back(
        {kStart + i * kPeriod, Vec3(6.0, 0, 0),
         kDown * Vec3(0, std::sin(angle), std::cos(angle)) +
             2.0 * Vec3(std::sin(13.0 * t), std::cos(7.0 * t), std::sin(3.0 * t))});
  }
  EXPECT_EQ(conditioned(raw).report.gyro_unit, GyroUnit::Radians);
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
  for (std::size_t i = 0; i < raw.size(); ++i)
    raw[i].gyro.x() += 4.0 * std::sin(toSeconds(raw[i].stamp_ns - kStart) * 20.0);
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

}  // namespace fastlio
