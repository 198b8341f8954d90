// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/arrival_clock.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace fastlio
{
namespace
{
constexpr std::int64_t kSecond = 1'000'000'000, kHour = 3600 * kSecond;
constexpr std::int64_t kStart = 1'700'000'000 * kSecond;
constexpr std::int64_t kPeriod = 1'327'000;  // of a VLP-16's packets

TEST(ArrivalClock, TheLeastDelayIsTaken)
{
  std::mt19937 random(1);
  std::exponential_distribution<double> delay(1.0 / 2e6);  // 2 ms on average
  ArrivalClock clock;
  std::int64_t worst = 0;
  for (int i = 0; i < 10'000; ++i)
  {
    const std::int64_t sensor = 5 * kSecond + i * kPeriod;
    const std::int64_t sent = kStart + i * kPeriod;
    const auto late = static_cast<std::int64_t>(delay(random));
    const std::int64_t error = clock.stampOf(sensor, sent + late) - sent;
    if (i > 200) worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(worst, 100'000);  // 0.1 ms, although packets are late by more than 10 ms at times
}

TEST(ArrivalClock, FollowsAClockThatDrifts)
{
  ArrivalClock clock;
  std::int64_t error = 0;
  for (std::int64_t t = 0; t < 600 * kSecond; t += kSecond / 100)
    error = clock.stampOf(t - t / 20'000, kStart + t) - (kStart + t);  // 50 ppm too slow
  EXPECT_LT(std::abs(error), 100'000);
}

TEST(ArrivalClock, TheSensorsClockBeginsAgainEachHour)
{
  ArrivalClock clock;
  for (std::int64_t t = 0; t < 3 * kSecond; t += kPeriod)
  {
    const std::int64_t stamp = clock.stampOf((kHour - kSecond + t) % kHour, kStart + t);
    EXPECT_LT(std::abs(stamp - (kStart + t)), 1'000'000) << t;
  }
}

TEST(ArrivalClock, ASensorThatStartsAgainGetsANewOffset)
{
  ArrivalClock clock;
  (void)clock.stampOf(1000 * kSecond, kStart);
  (void)clock.stampOf(1001 * kSecond, kStart + kSecond);
  EXPECT_EQ(clock.stampOf(kSecond / 2, kStart + 20 * kSecond), kStart + 20 * kSecond);
  EXPECT_EQ(clock.stampOf(kSecond, kStart + 41 * kSecond / 2), kStart + 41 * kSecond / 2);
}
}  // namespace
}  // namespace fastlio
