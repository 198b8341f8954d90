// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Times of points, read in a way that is known, as seconds after the stamp.

#include <fastlio/lidar/point_time.h>

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

constexpr std::int64_t kStamp = 1'700'000'000'000'000'000;
constexpr double kStampSeconds = 1.7e9;
}  // namespace

TEST(PointTimeReading, TheFirstAndTheLastPointAreNoWildOnes)
{
  for (const Reference reference : {Reference::Start, Reference::Middle, Reference::End})
    for (const double wild : {-1e15, 1e15, std::numeric_limits<double>::infinity()})
    {
      std::vector<double> right, damaged;
      for (int i = 0; i <= 100; ++i)
        right.push_back(7e12 + 1e6 * i);
      damaged = right;
      damaged.insert(damaged.begin() + 40, wild);
      toSecondsAfterStamp(right, kStamp, {Unit::Nanoseconds, reference});
      toSecondsAfterStamp(damaged, kStamp, {Unit::Nanoseconds, reference});
      EXPECT_GT(std::abs(damaged[40]), kMaxTimeOffset);
      damaged.erase(damaged.begin() + 40);
      EXPECT_EQ(damaged, right) << nameOf(reference) << " " << wild;
    }
}

TEST(PointTimeReading, ReadingGivesSecondsAfterTheStamp)
{
  const auto read = [](std::vector<double> times, PointTimeReading reading)
  {
    toSecondsAfterStamp(times, kStamp, reading);
    return times;
  };
  EXPECT_DOUBLE_EQ(read({50.0}, {Unit::Milliseconds, Reference::Stamp})[0], 0.05);
  EXPECT_DOUBLE_EQ(read({7e6, 8e6}, {Unit::Nanoseconds, Reference::Start})[1], 1e-3);
  EXPECT_DOUBLE_EQ(read({7e3, 8e3}, {Unit::Microseconds, Reference::Middle})[0], -5e-4);
  EXPECT_DOUBLE_EQ(read({1.0, 1.1}, {Unit::Seconds, Reference::End})[1], 0.0);
  EXPECT_NEAR(
      read({kStampSeconds + 0.0625}, {Unit::Seconds, Reference::Absolute})[0], 0.0625, 3e-7);
  EXPECT_NEAR(
      read({(kStampSeconds + 0.0625) * 1e9}, {Unit::Nanoseconds, Reference::Absolute})[0], 0.0625,
      3e-7);
  std::vector<double> times{1.0};
  EXPECT_THROW(
      toSecondsAfterStamp(times, 0, {Unit::Auto, Reference::Stamp}), std::invalid_argument);
  EXPECT_THROW(
      toSecondsAfterStamp(times, 0, {Unit::Seconds, Reference::Auto}), std::invalid_argument);
}

}  // namespace fastlio
