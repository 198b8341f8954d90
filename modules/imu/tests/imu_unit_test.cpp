// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "conditioned_samples.h"

#include <gtest/gtest.h>

namespace fastlio::testing
{
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
    raw.reserve(1000);
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
  raw.reserve(1000);
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
}  // namespace fastlio::testing
