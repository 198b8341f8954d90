// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_buffer.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace fastlio
{
namespace
{
constexpr std::int64_t kFirstStamp = 1'700'000'000'000'000'000;
constexpr std::int64_t kMs = 1'000'000;

ImuSample sampleAt(std::int64_t stamp_ns, double value = 0.0)
{
  return {stamp_ns, Vec3(value, 2.0 * value, -value), Vec3(10.0 * value, value, 5.0)};
}

/** Samples at uneven distances of 1 to 9 ms with random values. */
std::vector<ImuSample> unevenSamples(unsigned seed, int count)
{
  std::mt19937 rng(seed);
  std::uniform_int_distribution<std::int64_t> period(1 * kMs, 9 * kMs);
  std::uniform_real_distribution<double> value(-3.0, 3.0);
  std::vector<ImuSample> samples;
  std::int64_t stamp = kFirstStamp;
  for (int i = 0; i < count; ++i, stamp += period(rng))
    samples.push_back(sampleAt(stamp, value(rng)));
  return samples;
}

ImuBuffer bufferOf(const std::vector<ImuSample>& samples)
{
  ImuBuffer buffer;
  for (const ImuSample& s : samples)
    EXPECT_EQ(buffer.add(s), ImuBuffer::Verdict::Accepted);
  return buffer;
}

std::vector<ImuSample> inputs(
    const ImuBuffer& buffer, std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold)
{
  std::vector<ImuSample> result;
  buffer.inputsBetween(begin_ns, end_ns, hold, result);
  return result;
}

/** Integral over time [s] of inputs that hold until the next one, the last until end_ns. */
Vec3 gyroIntegral(const std::vector<ImuSample>& inputs, std::int64_t end_ns)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs.size() ? inputs[i + 1].stamp_ns : end_ns;
    sum += inputs[i].gyro * (toSeconds(stop_ns - inputs[i].stamp_ns));
  }
  return sum;
}

/** The signal between the samples at an instant; constant before the first and after the last. */
Vec3 gyroAt(const std::vector<ImuSample>& samples, std::int64_t stamp_ns, ImuHold hold)
{
  if (stamp_ns <= samples.front().stamp_ns) return samples.front().gyro;
  if (stamp_ns >= samples.back().stamp_ns) return samples.back().gyro;
  const auto right = std::upper_bound(
      samples.begin(), samples.end(), stamp_ns,
      [](std::int64_t t, const ImuSample& s) { return t < s.stamp_ns; });
  const auto left = right - 1;
  if (hold == ImuHold::Left) return left->gyro;
  const double fraction =
      double(stamp_ns - left->stamp_ns) / double(right->stamp_ns - left->stamp_ns);
  return left->gyro + fraction * (right->gyro - left->gyro);
}

/** Integral of gyroAt by its corners: exact for steps and for straight lines. */
Vec3 gyroIntegral(
    const std::vector<ImuSample>& samples, std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold)
{
  std::vector<std::int64_t> corners{begin_ns, end_ns};
  for (const ImuSample& s : samples)
    if (s.stamp_ns > begin_ns && s.stamp_ns < end_ns) corners.push_back(s.stamp_ns);
  std::sort(corners.begin(), corners.end());
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
  {
    const std::int64_t middle = corners[i] + (corners[i + 1] - corners[i]) / 2;
    sum += gyroAt(samples, middle, hold) * (toSeconds(corners[i + 1] - corners[i]));
  }
  return sum;
}

bool sameInputs(const std::vector<ImuSample>& a, const std::vector<ImuSample>& b)
{
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const ImuSample& s, const ImuSample& t)
      { return s.stamp_ns == t.stamp_ns && s.gyro == t.gyro && s.accel == t.accel; });
}

TEST(ImuBuffer, SaysWhyASampleIsNotTaken)
{
  ImuBuffer buffer;
  ImuSample bad = sampleAt(kFirstStamp);
  bad.accel.z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(buffer.add(bad), ImuBuffer::Verdict::NotFinite);
  bad = sampleAt(kFirstStamp);
  bad.gyro.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(buffer.add(bad), ImuBuffer::Verdict::NotFinite);
  EXPECT_TRUE(buffer.empty());
  EXPECT_EQ(buffer.add(sampleAt(kFirstStamp)), ImuBuffer::Verdict::Accepted);
  EXPECT_EQ(buffer.add(sampleAt(kFirstStamp, 1.0)), ImuBuffer::Verdict::Duplicate);
  EXPECT_EQ(buffer.add(sampleAt(kFirstStamp - 1)), ImuBuffer::Verdict::OutOfOrder);
  EXPECT_EQ(buffer.add(sampleAt(kFirstStamp + 1)), ImuBuffer::Verdict::Accepted);
  EXPECT_EQ(buffer.oldestStamp(), kFirstStamp);
  EXPECT_EQ(buffer.newestStamp(), kFirstStamp + 1);
}

TEST(ImuBuffer, InputsCoverAnyIntervalWithoutGapsAndWithTheSignalsIntegral)
{
  const auto samples = unevenSamples(1, 200);
  const ImuBuffer buffer = bufferOf(samples);
  std::mt19937 rng(2);
  // Reaches beyond both ends of the data.
  std::uniform_int_distribution<std::int64_t> stamp(
      kFirstStamp - 50 * kMs, samples.back().stamp_ns + 50 * kMs);
  for (int k = 0; k < 2000; ++k)
  {
    std::int64_t begin = stamp(rng), end = stamp(rng);
    if (begin > end) std::swap(begin, end);
    if (k % 3 == 0) begin = samples[std::size_t(k) % 200].stamp_ns;  // borders on samples too
    if (k % 4 == 0) end = samples[std::size_t(k * 7) % 200].stamp_ns;
    for (const ImuHold hold : {ImuHold::Midpoint, ImuHold::Left})
    {
      const auto found = inputs(buffer, begin, end, hold);
      ASSERT_EQ(found.empty(), begin >= end);
      if (found.empty()) continue;
      EXPECT_EQ(found.front().stamp_ns, begin);
      EXPECT_LT(found.back().stamp_ns, end);
      for (std::size_t i = 0; i + 1 < found.size(); ++i)
        ASSERT_LT(found[i].stamp_ns, found[i + 1].stamp_ns);
      const Vec3 expected = gyroIntegral(samples, begin, end, hold);
      EXPECT_LT((gyroIntegral(found, end) - expected).norm(), 1e-8);
    }
  }
}

TEST(ImuBuffer, HoldsTheLeftSampleOrTheMiddleOfThePeriod)
{
  const ImuBuffer buffer =
      bufferOf({sampleAt(kFirstStamp, 1.0), sampleAt(kFirstStamp + 10 * kMs, 3.0)});
  const auto left = inputs(buffer, kFirstStamp + 2 * kMs, kFirstStamp + 6 * kMs, ImuHold::Left);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].gyro.x(), 1.0);
  const auto middle =
      inputs(buffer, kFirstStamp + 2 * kMs, kFirstStamp + 6 * kMs, ImuHold::Midpoint);
  ASSERT_EQ(middle.size(), 1U);
  EXPECT_NEAR(middle[0].gyro.x(), 1.8, 1e-12);
  EXPECT_NEAR(middle[0].accel.x(), 18.0, 1e-12);
}

TEST(ImuBuffer, TheNearestSampleHoldsOutsideOfTheData)
{
  const ImuBuffer buffer =
      bufferOf({sampleAt(kFirstStamp, 1.0), sampleAt(kFirstStamp + 10 * kMs, 3.0)});
  for (const ImuHold hold : {ImuHold::Midpoint, ImuHold::Left})
  {
    const auto before = inputs(buffer, kFirstStamp - 20 * kMs, kFirstStamp - 10 * kMs, hold);
    ASSERT_EQ(before.size(), 1U);
    EXPECT_EQ(before[0].gyro.x(), 1.0);
    const auto after = inputs(buffer, kFirstStamp + 20 * kMs, kFirstStamp + 30 * kMs, hold);
    ASSERT_EQ(after.size(), 1U);
    EXPECT_EQ(after[0].gyro.x(), 3.0);
  }
}

TEST(ImuBuffer, GivesNoInputsWithoutSamplesOrTime)
{
  std::vector<ImuSample> reused(3);
  ImuBuffer{}.inputsBetween(kFirstStamp, kFirstStamp + kMs, ImuHold::Midpoint, reused);
  EXPECT_TRUE(reused.empty());
  const ImuBuffer buffer = bufferOf({sampleAt(kFirstStamp)});
  EXPECT_TRUE(inputs(buffer, kFirstStamp, kFirstStamp, ImuHold::Midpoint).empty());
  EXPECT_TRUE(inputs(buffer, kFirstStamp, kFirstStamp - kMs, ImuHold::Midpoint).empty());
  EXPECT_EQ(inputs(buffer, kFirstStamp, kFirstStamp + kMs, ImuHold::Midpoint).size(), 1U);
}

TEST(ImuBuffer, FindsTheLongestGapThatAnIntervalTouches)
{
  const ImuBuffer buffer = bufferOf(
      {sampleAt(kFirstStamp), sampleAt(kFirstStamp + 5 * kMs), sampleAt(kFirstStamp + 45 * kMs),
       sampleAt(kFirstStamp + 50 * kMs)});
  EXPECT_EQ(buffer.longestGap(kFirstStamp, kFirstStamp + 5 * kMs), 5 * kMs);
  EXPECT_EQ(buffer.longestGap(kFirstStamp, kFirstStamp + 6 * kMs), 40 * kMs);
  EXPECT_EQ(buffer.longestGap(kFirstStamp + 20 * kMs, kFirstStamp + 30 * kMs), 40 * kMs);
  EXPECT_EQ(buffer.longestGap(kFirstStamp + 45 * kMs, kFirstStamp + 50 * kMs), 5 * kMs);
  // Samples missing at the ends count too.
  EXPECT_EQ(buffer.longestGap(kFirstStamp + 46 * kMs, kFirstStamp + 150 * kMs), 100 * kMs);
  EXPECT_EQ(buffer.longestGap(kFirstStamp - 70 * kMs, kFirstStamp + 4 * kMs), 70 * kMs);
}

TEST(ImuBuffer, GivesTheSamplesOfAClosedInterval)
{
  const auto samples = unevenSamples(3, 50);
  const ImuBuffer buffer = bufferOf(samples);
  const auto some = buffer.samplesBetween(samples[10].stamp_ns, samples[20].stamp_ns);
  EXPECT_TRUE(sameInputs(some, {samples.begin() + 10, samples.begin() + 21}));
  EXPECT_TRUE(buffer.samplesBetween(samples[10].stamp_ns + 1, samples[11].stamp_ns - 1).empty());
  EXPECT_EQ(buffer.samplesBetween(kFirstStamp - kMs, samples.back().stamp_ns + kMs).size(), 50U);
}

TEST(ImuBuffer, ForgettingChangesNoLaterInput)
{
  // Long enough that the storage is compacted many times.
  const auto samples = unevenSamples(4, 20000);
  const ImuBuffer all = bufferOf(samples);
  ImuBuffer forgetful;
  std::int64_t forgotten = kFirstStamp;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    forgetful.add(samples[i]);
    if (i % 20 != 19) continue;
    forgotten = samples[i].stamp_ns - 40 * kMs;  // between two samples or on one
    forgetful.forgetBefore(forgotten);
    for (const ImuHold hold : {ImuHold::Midpoint, ImuHold::Left})
    {
      const std::int64_t end = samples[i].stamp_ns;
      ASSERT_TRUE(
          sameInputs(inputs(forgetful, forgotten, end, hold), inputs(all, forgotten, end, hold)));
      ASSERT_EQ(forgetful.longestGap(forgotten, end), all.longestGap(forgotten, end));
    }
  }
  EXPECT_GE(forgetful.oldestStamp(), forgotten - 9 * kMs);
  EXPECT_LE(forgetful.oldestStamp(), forgotten);
}

TEST(ImuBuffer, ForgetsTheSamplesBeforeAnInstantAcrossAGap)
{
  const auto buffer = []
  {
    return bufferOf(
        {sampleAt(kFirstStamp), sampleAt(kFirstStamp + kMs), sampleAt(kFirstStamp + 900 * kMs)});
  };
  ImuBuffer on_sample = buffer(), in_gap = buffer(), behind = buffer(), ahead = buffer();
  on_sample.forgetSamplesBefore(kFirstStamp + kMs);
  EXPECT_EQ(on_sample.oldestStamp(), kFirstStamp + kMs);
  in_gap.forgetSamplesBefore(kFirstStamp + kMs + 1);
  EXPECT_EQ(in_gap.oldestStamp(), kFirstStamp + 900 * kMs);
  behind.forgetSamplesBefore(kFirstStamp + 1000 * kMs);
  EXPECT_EQ(behind.oldestStamp(), kFirstStamp + 900 * kMs) << "the newest stays";
  ahead.forgetSamplesBefore(kFirstStamp);
  EXPECT_EQ(ahead.oldestStamp(), kFirstStamp);
  ImuBuffer{}.forgetSamplesBefore(kFirstStamp);
}

TEST(ImuBuffer, ForgettingKeepsTheNewestSample)
{
  ImuBuffer buffer = bufferOf({sampleAt(kFirstStamp), sampleAt(kFirstStamp + kMs, 2.0)});
  buffer.forgetBefore(kFirstStamp + 1000 * kMs);
  ASSERT_FALSE(buffer.empty());
  EXPECT_EQ(buffer.oldestStamp(), kFirstStamp + kMs);
  EXPECT_EQ(buffer.add(sampleAt(kFirstStamp + kMs)), ImuBuffer::Verdict::Duplicate);
  buffer.forgetBefore(kFirstStamp - kMs);
  EXPECT_EQ(buffer.oldestStamp(), kFirstStamp + kMs);
}
}  // namespace
}  // namespace fastlio
