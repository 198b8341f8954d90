// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_clipping.h>
#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::int64_t kFirst = 1'700'000'000'000'000'000, kStep = 5'000'000;
constexpr double kRateFloor = 1.7, kForceFloor = 17.0;

/** Two seconds at rest, then a walk. */
std::vector<ImuSample> walk(double gyro_noise, double accel_noise)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<ImuSample> samples;
  for (int i = 0; i < 4000; ++i)
  {
    const double t = toSeconds(i * kStep) - 2.0, moving = t > 0.0 ? 1.0 : 0.0;
    const Vec3 gyro(
        0.2 * std::sin(11.0 * t), 0.3 * std::sin(9.0 * t + 1.0), 1.5 * std::sin(1.3 * t));
    const Vec3 accel(
        1.1 * std::sin(12.0 * t), 1.3 * std::cos(6.0 * t),
        3.0 * std::sin(12.0 * t + 1.0) + 1.2 * std::sin(31.0 * t));
    ImuSample sample;
    sample.stamp_ns = kFirst + i * kStep;
    for (int axis = 0; axis < 3; ++axis)
    {
      sample.gyro[axis] = moving * gyro[axis] + gyro_noise * normal(random);
      sample.accel[axis] = moving * accel[axis] + accel_noise * normal(random);
    }
    sample.accel.z() += 9.81;
    samples.push_back(sample);
  }
  return samples;
}

void toSteps(std::vector<ImuSample>& samples, double gyro, double accel)
{
  const auto rounded = [](double value, double step) { return step * std::round(value / step); };
  for (ImuSample& sample : samples)
    for (int axis = 0; axis < 3; ++axis)
    {
      sample.gyro[axis] = rounded(sample.gyro[axis], gyro);
      sample.accel[axis] = rounded(sample.accel[axis], accel);
    }
}

void clip(std::vector<ImuSample>& samples, double gyro, double accel)
{
  for (ImuSample& sample : samples)
    for (int axis = 0; axis < 3; ++axis)
    {
      sample.gyro[axis] = std::clamp(sample.gyro[axis], -gyro, gyro);
      sample.accel[axis] = std::clamp(sample.accel[axis], -accel, accel);
    }
}

struct Found
{
  std::size_t gyro = 0, accel = 0;  // clipped readings
  std::optional<RangeEnd> gyro_end, accel_end;
};

Found found(const std::vector<ImuSample>& samples)
{
  ClippingDetector gyro(0.0, kRateFloor), accel(0.0, kForceFloor);
  Found found;
  ImuSample before;
  for (const ImuSample& sample : samples)
  {
    const bool held = sample.gyro == before.gyro && sample.accel == before.accel;
    found.gyro += gyro.add(sample.gyro, held) > 0.0 ? 1 : 0;
    found.accel += accel.add(sample.accel, held) > 0.0 ? 1 : 0;
    before = sample;
  }
  found.gyro_end = gyro.takeFound();
  found.accel_end = accel.takeFound();
  return found;
}

std::size_t atEnd(const std::vector<ImuSample>& samples, double accel)
{
  return static_cast<std::size_t>(std::count_if(
      samples.begin(), samples.end(),
      [=](const ImuSample& s) { return s.accel.z() >= accel * (1.0 - 1e-9); }));
}
}  // namespace

class RangesOfTheAccelerometer : public ::testing::TestWithParam<double>
{
};

// Also where the sensor is clipped at rest, and in the steps of a real sensor.
TEST_P(RangesOfTheAccelerometer, AreFoundAtAnyLevel)
{
  for (const double step : {1e-6, 0.0048})
  {
    auto samples = walk(0.002, 0.02);
    toSteps(samples, step, step);
    const double range = step * std::round(GetParam() / step);
    clip(samples, 100.0, range);
    const Found f = found(samples);
    const std::size_t clipped = atEnd(samples, range);
    EXPECT_GT(f.accel, clipped / 2) << "steps of " << step;
    EXPECT_LE(f.accel, clipped);
    EXPECT_EQ(f.gyro, 0U);
    ASSERT_TRUE(f.accel_end.has_value());
    EXPECT_EQ(f.accel_end->axis, 2);
    EXPECT_DOUBLE_EQ(f.accel_end->value, range);
  }
}

INSTANTIATE_TEST_SUITE_P(Level, RangesOfTheAccelerometer, ::testing::Values(9.7, 9.81, 10.0, 12.0));

TEST(ClippingDetector, FindsTheRangeOfAGyroInASingleLongTurn)
{
  auto samples = walk(0.002, 0.02);
  toSteps(samples, 0.001, 0.0048);
  clip(samples, 0.8, 100.0);
  samples.resize(800);  // two seconds in motion
  const Found f = found(samples);
  EXPECT_GT(f.gyro, 100U);
  ASSERT_TRUE(f.gyro_end.has_value());
  EXPECT_EQ(f.gyro_end->axis, 2);
  EXPECT_DOUBLE_EQ(f.gyro_end->value, 0.8);
  EXPECT_EQ(f.accel, 0U);
}

TEST(ClippingDetector, CoarseSensorsAreNotClipped)
{
  for (const double gyro : {0.001, 0.01, 0.1, 0.5})
    for (const double accel : {0.005, 0.05, 0.5, 2.0})
    {
      auto samples = walk(0.002, 0.02);
      toSteps(samples, gyro, accel);
      const Found f = found(samples);
      EXPECT_EQ(f.gyro, 0U) << "steps of " << gyro;
      EXPECT_EQ(f.accel, 0U) << "steps of " << accel;
    }
}

// The same beyond the floor, where one run of readings suffices.
TEST(ClippingDetector, CoarseSensorsInFastMotionAreNotClipped)
{
  auto samples = walk(0.0, 0.0);
  for (ImuSample& sample : samples)
  {
    sample.gyro *= 4.0;
    sample.accel.z() = 9.81 + 4.0 * (sample.accel.z() - 9.81);
  }
  toSteps(samples, 0.1, 1.0);
  const Found f = found(samples);
  EXPECT_EQ(f.gyro, 0U);
  EXPECT_EQ(f.accel, 0U);
}

TEST(ClippingDetector, RepeatedReadingsAreNotClipped)
{
  for (const double factor : {1.0, 4.0})  // below the floor, and beyond
    for (const std::size_t times : {2U, 4U, 10U})
      for (const bool with_accel : {false, true})
      {
        auto samples = walk(0.002, 0.02);
        for (ImuSample& sample : samples)
          sample.gyro *= factor;
        toSteps(samples, 0.001, 0.0048);
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
          samples[i].gyro = samples[i - i % times].gyro;
          if (with_accel) samples[i].accel = samples[i - i % times].accel;
        }
        EXPECT_EQ(found(samples).gyro, 0U) << times << " times, factor " << factor;
        EXPECT_EQ(found(samples).accel, 0U) << times << " times, factor " << factor;
      }
}

TEST(ClippingDetector, AxesOfZerosAndConstantsAreNotClipped)
{
  auto samples = walk(0.002, 0.02);
  for (ImuSample& sample : samples)
  {
    sample.gyro.head<2>().setZero();
    sample.accel = Vec3(0.0, 0.0, 9.81);
  }
  const Found f = found(samples);
  EXPECT_EQ(f.gyro, 0U);
  EXPECT_EQ(f.accel, 0U);
}

TEST(ClippingDetector, ATurntableAtAConstantRateIsNotClipped)
{
  auto samples = walk(0.002, 0.02);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const double ramp = std::min(1.0, static_cast<double>(i % 1000) / 200.0);
    samples[i].gyro = Vec3(0.0, 0.0, 1.5 * ramp);
  }
  toSteps(samples, 0.02, 0.0048);
  EXPECT_EQ(found(samples).gyro, 0U);
}

TEST(ClippingDetector, ALargerReadingRefutesTheRange)
{
  auto samples = walk(0.002, 0.02);
  auto clipped = samples;
  clip(clipped, 100.0, 11.0);
  for (const ImuSample& sample : samples)
    clipped.push_back(sample);
  const Found all = found(clipped);
  clipped.resize(samples.size());
  EXPECT_GT(all.accel, 0U);
  EXPECT_EQ(all.accel, found(clipped).accel);
}

// Four equal readings at the flank of a peak: noise did that. The sentence had been said by then.
TEST(ClippingDetector, NothingIsToldOfARangeThatTheNextReadingRefutes)
{
  auto samples = walk(0.002, 0.02);
  toSteps(samples, 0.001, 0.0048);
  const auto top = [&](double next)
  {
    auto changed = samples;
    for (std::size_t i = 1000; i < 1004; ++i)
      changed[i].gyro.z() = 1.8;
    changed[1004].gyro.z() = next;
    return found(changed);
  };
  EXPECT_TRUE(top(1.5).gyro_end.has_value());
  const Found refuted = top(1.9);
  EXPECT_GT(refuted.gyro, 0U);
  EXPECT_FALSE(refuted.gyro_end.has_value());
}

TEST(ImuConditioner, TellsWhichAxisClipsAndWhere)
{
  auto samples = walk(0.002, 0.02);
  clip(samples, 0.8, 10.0);
  ImuConditioner conditioner({}, 9.81);
  int longest = 0;
  bool inflated = false;
  for (const ImuSample& sample : samples)
    for (const ConditionedSample& out : conditioner.add(sample))
      if (out.inflation)
      {
        longest = std::max(longest, out.inflation->in_a_row);
        inflated = inflated || out.inflation->accel_std > 4.0;
      }
  std::string text;
  for (const Diagnostic& diagnostic : conditioner.takeDiagnostics())
    text += diagnostic.text + "\n";
  EXPECT_NE(text.find("the gyro clips at 0.8 rad/s: readings of its axis z"), std::string::npos)
      << text;
  EXPECT_NE(
      text.find("the accelerometer clips at 10 m/s^2: readings of its axis z"), std::string::npos)
      << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  EXPECT_GT(longest, 51) << "a turn beyond the range lasts: its errors have one sign";
  EXPECT_TRUE(inflated);
}

}  // namespace fastlio
