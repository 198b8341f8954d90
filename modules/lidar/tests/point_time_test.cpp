// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The interpretation of time fields, and refusals.

#include <fastlio/lidar/point_time.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{
using Unit = PointTimeUnit;
using Reference = PointTimeReference;

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr double kStartSeconds = 1.7e9;

/** A recording of scans that last 0.1 s, and how its driver writes the times. */
struct Driver
{
  double unit = 1.0;
  double first = 0.0;        //!< earliest point minus stamp [s]
  double period = 0.1;       //!< of the stamps [s]
  double length = 0.0999;    //!< of a scan [s]
  bool clock = false;        //!< times advance ...
  double clock_error = 0.0;  //!< ... and are ahead of the stamps [s]
  double jitter = 0.0;       //!< of the stamps [s]
  bool single_precision = false;
  int scans = 20;

  [[nodiscard]] std::vector<PointTimeSample> samples() const
  {
    std::vector<PointTimeSample> all;
    for (int k = 0; k < scans; ++k)
    {
      const double true_s = k * period;
      const double stamp_s = true_s + jitter * std::sin(1.7 * k);
      const double epoch = clock ? kStartSeconds + true_s + clock_error : 0.0;
      std::vector<double> times;
      for (int i = 0; i <= 100; ++i)
        times.push_back((epoch + first + 0.01 * i * length) / unit);
      if (single_precision)
        for (double& t : times)
          t = static_cast<double>(static_cast<float>(t));
      all.push_back(sampleOf(kStart + toNanoseconds(stamp_s), times, single_precision));
    }
    return all;
  }
};

void expectFound(const PointTimeFinding& finding, Unit unit, Reference reference)
{
  EXPECT_EQ(finding.verdict, PointTimeVerdict::Found) << finding.evidence;
  EXPECT_STREQ(nameOf(finding.reading.unit), nameOf(unit)) << finding.evidence;
  EXPECT_STREQ(nameOf(finding.reading.reference), nameOf(reference)) << finding.evidence;
}

void expectText(const PointTimeFinding& finding, const std::string& text)
{
  EXPECT_NE(finding.evidence.find(text), std::string::npos)
      << "no '" << text << "' in: " << finding.evidence;
}

class EveryUnit : public ::testing::TestWithParam<Unit>
{
};
}  // namespace

TEST_P(EveryUnit, RelativeToAnyPlaceOfTheScan)
{
  for (const double first : {0.0, -0.05, -0.0999, 0.003})
    for (const bool single : {false, true})
    {
      Driver driver;
      driver.unit = secondsPer(GetParam());
      driver.first = first;
      driver.single_precision = single;
      const PointTimeFinding finding = findPointTimes(driver.samples());
      expectFound(finding, GetParam(), Reference::Stamp);
      EXPECT_NEAR(finding.begin, first, 1e-6);
      EXPECT_NEAR(finding.end, first + 0.0999, 1e-6);
      EXPECT_NEAR(finding.scan_period, 0.1, 1e-9);
      expectText(finding, "0.1 s");
    }
}

TEST_P(EveryUnit, AnyRateOfScansAndShareOfThePeriod)
{
  for (const double period : {0.005, 0.02, 0.1, 1.0})
    for (const double fraction : {0.06, 0.3, 1.0, 1.4})
    {
      Driver driver;
      driver.unit = secondsPer(GetParam());
      driver.period = period;
      driver.length = fraction * period;
      expectFound(findPointTimes(driver.samples()), GetParam(), Reference::Stamp);
    }
}

TEST_P(EveryUnit, AbsoluteTimes)
{
  for (const double first : {0.0, -0.05, -0.0999, 0.02})
    for (const int scans : {1, 20})
    {
      Driver driver;
      driver.unit = secondsPer(GetParam());
      driver.clock = true;
      driver.first = first;
      driver.jitter = 0.004;
      driver.scans = scans;
      const PointTimeFinding finding = findPointTimes(driver.samples());
      expectFound(finding, GetParam(), Reference::Absolute);
      EXPECT_NEAR(finding.begin, first, 0.0041);
    }
}

TEST_P(EveryUnit, ForeignClockIsAmbiguousUntilTheReferenceIsGiven)
{
  Driver driver;
  driver.unit = secondsPer(GetParam());
  driver.clock = true;
  driver.clock_error = -kStartSeconds + 4711.0;  // since the sensor was switched on
  const PointTimeFinding finding = findPointTimes(driver.samples());
  EXPECT_EQ(finding.verdict, PointTimeVerdict::Ambiguous) << finding.evidence;
  ASSERT_EQ(finding.candidates.size(), 2U);
  EXPECT_EQ(finding.candidates[0].reference, Reference::Start);
  EXPECT_EQ(finding.candidates[1].reference, Reference::End);
  expectText(finding, "input.point_time_reference");
  expectText(finding, "-1.7e+09 s ahead");
  expectText(finding, "in two ways");
  expectText(finding, "input.point_time_reference: start or end");
  const PointTimeFinding given = findPointTimes(driver.samples(), {Unit::Auto, Reference::End});
  expectFound(given, GetParam(), Reference::End);
  EXPECT_NEAR(given.end, 0.0, 1e-9);
  EXPECT_NEAR(given.begin, -0.0999, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    PointTime, EveryUnit,
    ::testing::Values(Unit::Seconds, Unit::Milliseconds, Unit::Microseconds, Unit::Nanoseconds),
    [](const auto& parameter) { return nameOf(parameter.param); });

TEST(PointTime, LeapSecondsLeaveThreeReadings)
{
  Driver driver;
  driver.clock = true;
  driver.clock_error = 37.0;
  const PointTimeFinding finding = findPointTimes(driver.samples());
  EXPECT_EQ(finding.verdict, PointTimeVerdict::Ambiguous);
  EXPECT_EQ(finding.candidates.size(), 3U);
  expectText(finding, "37 s ahead");
  expectText(finding, "in three ways");
  expectText(finding, "input.point_time_reference: start, end or absolute");
}

TEST(PointTime, BothUnitsAreShownWhenBothMakeSense)
{
  Driver driver;
  driver.length = 0.5;
  const PointTimeFinding finding = findPointTimes(driver.samples());
  ASSERT_EQ(finding.verdict, PointTimeVerdict::Ambiguous) << finding.evidence;
  ASSERT_EQ(finding.candidates.size(), 2U);
  EXPECT_EQ(finding.candidates[0].unit, Unit::Seconds);
  EXPECT_EQ(finding.candidates[1].unit, Unit::Milliseconds);
  expectText(finding, "read as s a scan lasts 0.5 s, 5 times the scan period of 0.1 s");
  expectText(finding, "read as ms a scan lasts 0.0005 s, 0.005 times");
  expectText(finding, "input.point_time_unit: s or ms");
  expectFound(
      findPointTimes(driver.samples(), {Unit::Milliseconds, Reference::Auto}), Unit::Milliseconds,
      Reference::Stamp);
}

TEST(PointTime, WhatIsConfiguredIsDone)
{
  Driver driver;  // seconds after the stamp
  expectFound(
      findPointTimes(driver.samples(), {Unit::Milliseconds, Reference::Middle}), Unit::Milliseconds,
      Reference::Middle);
  const PointTimeFinding end = findPointTimes(driver.samples(), {Unit::Auto, Reference::End});
  expectFound(end, Unit::Seconds, Reference::End);
  EXPECT_NEAR(end.begin, -0.0999, 1e-9);
}

TEST(PointTime, OneScanIsJudgedByAUsualPeriod)
{
  Driver driver;
  driver.scans = 1;
  driver.unit = 1e-9;
  const PointTimeFinding finding = findPointTimes(driver.samples());
  expectFound(finding, Unit::Nanoseconds, Reference::Stamp);
  expectText(finding, "one scan only");
}

TEST(PointTime, NoTimesAndEqualTimes)
{
  EXPECT_EQ(findPointTimes({}).verdict, PointTimeVerdict::Absent);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
      findPointTimes({sampleOf(kStart, {}, true), sampleOf(kStart + 1, {nan, nan}, true)}).verdict,
      PointTimeVerdict::Absent);
  Driver driver;
  driver.length = 0.0;
  EXPECT_EQ(findPointTimes(driver.samples()).verdict, PointTimeVerdict::Instantaneous);
  driver.first = 0.05;
  EXPECT_EQ(findPointTimes(driver.samples()).verdict, PointTimeVerdict::Instantaneous);
}

TEST(PointTime, DatesInSinglePrecisionAreUnusable)
{
  for (const double unit : {1.0, 1e-3, 1e-6, 1e-9})
  {
    Driver driver;
    driver.clock = true;
    driver.single_precision = true;
    driver.unit = unit;
    const PointTimeFinding finding = findPointTimes(driver.samples());
    EXPECT_EQ(finding.verdict, PointTimeVerdict::Unusable) << unit << ": " << finding.evidence;
    expectText(finding, "64 bits");
  }
}

TEST(PointTime, NonsenseIsUnusable)
{
  Driver driver;
  driver.length = 1e5;
  driver.unit = 1e-9;
  EXPECT_EQ(findPointTimes(driver.samples()).verdict, PointTimeVerdict::Unusable);
  driver = {};
  driver.first = 3600.0;  // since the hour, and yet not advancing
  const PointTimeFinding finding = findPointTimes(driver.samples());
  EXPECT_EQ(finding.verdict, PointTimeVerdict::Unusable);
  expectText(finding, "more than 2 s from the stamp");
}

TEST(PointTime, NumbersThatAreNotFiniteDoNotDecide)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const PointTimeSample sample = sampleOf(kStart, {nan, 0.0, infinity, 0.09, -infinity}, false);
  EXPECT_EQ(sample.points, 2U);
  EXPECT_EQ(sample.max, 0.09);
  expectFound(findPointTimes({sample}), Unit::Seconds, Reference::Stamp);
}

TEST(PointTime, SingleWildTimesDoNotDecide)
{
  for (const Unit unit : {Unit::Seconds, Unit::Nanoseconds})
    for (const double wild : {-1e12, -40.0, 3600.0, 1e30})
    {
      std::vector<PointTimeSample> samples;
      for (int k = 0; k < 20; ++k)
      {
        std::vector<double> times;
        for (int i = 0; i <= 100; ++i)
          times.push_back(i == 33 ? wild : 0.000999 * i);
        for (double& t : times)
          t /= secondsPer(unit);
        samples.push_back(sampleOf(kStart + k * 100'000'000LL, times, false));
      }
      EXPECT_EQ(samples.front().points, 100U);
      const PointTimeFinding finding = findPointTimes(samples);
      expectFound(finding, unit, Reference::Stamp);
      EXPECT_NEAR(finding.end, 0.0999, 1e-9) << wild;
    }
}

}  // namespace fastlio
