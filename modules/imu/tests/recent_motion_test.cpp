// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/recent_motion.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace fastlio
{
namespace
{
constexpr std::int64_t kSpacing = 5'000'000;
constexpr int kHistory = 1000;  // samples: 5 s
const Vec3 kGravity(0.0, 0.0, 9.8);

using Signal = std::function<double(double seconds)>;

/** The same signal on both sensors, about one axis. */
ImuSample sampleOf(const Signal& signal, int i)
{
  const double value = signal(toSeconds(i * kSpacing));
  return {i * kSpacing, Vec3(0.0, value, 0.0), Vec3(0.0, 0.0, 9.8 + value)};
}

RecentMotion historyOf(const Signal& signal, int begin, int end)
{
  RecentMotion motion;
  for (int i = begin; i < end; ++i)
    motion.add(sampleOf(signal, i), false);
  return motion;
}

/** The true error of interpolating over a gap. */
double meanError(const Signal& signal, int first, int last)
{
  double integral = 0.0;
  for (int i = first; i < last; ++i)
    integral += 0.5 * (signal(toSeconds(i * kSpacing)) + signal(toSeconds((i + 1) * kSpacing)));
  return integral / (last - first) -
         0.5 * (signal(toSeconds(first * kSpacing)) + signal(toSeconds(last * kSpacing)));
}

struct NormalizedError
{
  double mean_square = 0.0, worst = 0.0;
};

/** The error of gaps at many places, relative to what RecentMotion says. */
NormalizedError normalizedError(const Signal& signal, int gap)
{
  NormalizedError normalized;
  int tried = 0;
  for (int begin = 0; begin < 2000; begin += 37, ++tried)
  {
    const RecentMotion motion = historyOf(signal, begin, begin + kHistory);
    const int first = begin + kHistory - 1, last = first + gap;
    const auto error = motion.errorUntil(sampleOf(signal, last));
    if (!error) return {};
    EXPECT_NEAR(error->gyro_std, error->accel_std, 1e-6 * error->gyro_std);
    const double sigmas = std::abs(meanError(signal, first, last)) / error->gyro_std;
    normalized.mean_square += sigmas * sigmas;
    normalized.worst = std::max(normalized.worst, sigmas);
  }
  normalized.mean_square /= tried;
  return normalized;
}

double steps(double t)
{
  return std::sin(2.0 * M_PI * 1.8 * t) + 0.3 * std::sin(2.0 * M_PI * 3.7 * t + 1.0);
}
}  // namespace

TEST(RecentMotion, CoversTheErrorInPeriodicMotion)
{
  for (const int gap : {10, 20, 40, 80})
  {
    const NormalizedError normalized = normalizedError(steps, gap);
    EXPECT_LT(normalized.worst, 2.0) << gap;
    EXPECT_GT(normalized.mean_square, 0.2) << gap;
  }
}

TEST(RecentMotion, CoversTheErrorInVibration)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> noise(4000);
  for (double& value : noise)
    value = normal(random);
  const Signal vibration = [&](double t)
  { return noise[static_cast<std::size_t>(std::lround(t / toSeconds(kSpacing)))]; };
  for (const int gap : {10, 40})
  {
    const NormalizedError normalized = normalizedError(vibration, gap);
    EXPECT_LT(normalized.worst, 2.0) << gap;
    EXPECT_GT(normalized.mean_square, 0.1) << gap;
  }
}

TEST(RecentMotion, CostsMoreTheLongerTheGapAndTheFasterTheMotion)
{
  const Signal slow = [](double t) { return std::sin(t); };
  const RecentMotion walk = historyOf(steps, 0, kHistory), car = historyOf(slow, 0, kHistory);
  const auto short_gap = walk.errorUntil(sampleOf(steps, kHistory + 10));
  const auto long_gap = walk.errorUntil(sampleOf(steps, kHistory + 40));
  const auto in_car = car.errorUntil(sampleOf(slow, kHistory + 40));
  ASSERT_TRUE(short_gap && long_gap && in_car);
  EXPECT_GT(long_gap->gyro_std, 3.0 * short_gap->gyro_std);
  EXPECT_LT(in_car->gyro_std, 0.05 * long_gap->gyro_std);
}

TEST(RecentMotion, AStartInAGapIsNoRest)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 0.001);
  RecentMotion rest;
  for (int i = 0; i < kHistory; ++i)
    rest.add({i * kSpacing, Vec3(normal(random), normal(random), normal(random)), kGravity}, false);
  ImuSample moving{(kHistory + 40) * kSpacing, Vec3(0.5, 0.0, 0.0), kGravity};
  const auto error = rest.errorUntil(moving);
  ASSERT_TRUE(error);
  EXPECT_GT(error->gyro_std, 0.5 / std::sqrt(12.0)) << "the rate may have changed at any time";
  EXPECT_LT(error->gyro_std, 0.5);
}

TEST(RecentMotion, LooksAcrossNoEarlierGap)
{
  // The rate jumps in each gap, and stands still between them.
  RecentMotion motion;
  for (int i = 0; i < kHistory; ++i)
  {
    const int turn = i / 100;
    motion.add({i * kSpacing, Vec3(turn, 0.0, 0.0), Vec3::Zero()}, i % 100 == 0);
  }
  const auto error = motion.errorUntil({(kHistory + 19) * kSpacing, Vec3(9.0, 0.0, 0.0), {}});
  ASSERT_TRUE(error);
  EXPECT_LT(error->gyro_std, 1e-9);
}

TEST(RecentMotion, SaysNothingWithoutEnoughSamples)
{
  EXPECT_FALSE(RecentMotion().newestStamp());
  EXPECT_FALSE(RecentMotion().errorUntil(sampleOf(steps, 40)));
  const RecentMotion motion = historyOf(steps, 0, 220);  // 1.1 s
  EXPECT_EQ(motion.newestStamp(), 219 * kSpacing);
  EXPECT_TRUE(motion.errorUntil(sampleOf(steps, 219 + 10)));
  EXPECT_FALSE(motion.errorUntil(sampleOf(steps, 219 + 40)));
  EXPECT_FALSE(motion.errorUntil(sampleOf(steps, 219 + 4000))) << "longer than what is remembered";
}

TEST(RecentMotion, ForgetsWhatIsLongAgo)
{
  // Wild at first, then calm for longer than is remembered.
  const Signal calmer = [](double t) { return (t < 10.0 ? 1.0 : 0.001) * steps(t); };
  const RecentMotion motion = historyOf(calmer, 0, 4000);
  const auto error = motion.errorUntil(sampleOf(calmer, 4019));
  ASSERT_TRUE(error);
  EXPECT_LT(error->gyro_std, 0.001);
}

TEST(RecentMotion, AbsurdSamplesLeaveNothingBehind)
{
  const RecentMotion calm = historyOf(steps, 10, 3000);
  RecentMotion absurd;
  for (int i = 0; i < 3000; ++i)
  {
    ImuSample sample = sampleOf(steps, i);
    if (i < 10) sample.gyro.setConstant(1e200), sample.accel.setConstant(1e200);
    absurd.add(sample, false);
  }
  const auto expected = calm.errorUntil(sampleOf(steps, 3019));
  const auto error = absurd.errorUntil(sampleOf(steps, 3019));
  ASSERT_TRUE(expected && error);
  EXPECT_EQ(error->gyro_std, expected->gyro_std);
  EXPECT_EQ(error->accel_std, expected->accel_std);
}

}  // namespace fastlio
