// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/noise_inflation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::int64_t kBegin = 1'700'000'000'000'000'000, kLength = 5'000'000;  // [ns]
}  // namespace

TEST(NoiseInflation, GrowsTheNoiseByItsShareOfTheInput)
{
  const ImuNoise noise;
  const std::vector<NoiseInflation> none, one{{kBegin, kBegin + kLength, 0.5, 2.0}};
  EXPECT_EQ(
      noiseBetween(noise, one, kBegin + kLength, kBegin + 2 * kLength).gyro_noise_density,
      noise.gyro_noise_density);
  const ImuNoise grown = noiseBetween(noise, one, kBegin, kBegin + 2 * kLength);
  const double dt = 1e-9 * 2.0 * static_cast<double>(kLength);
  EXPECT_NEAR(
      std::pow(grown.accel_noise_density, 2),
      std::pow(noise.accel_noise_density, 2) + 0.5 * 4.0 * dt, 1e-12);
  EXPECT_DOUBLE_EQ(inflatedRatio(one, kBegin, kBegin + 2 * kLength), 0.5);
  EXPECT_DOUBLE_EQ(inflatedRatio(none, kBegin, kBegin + 2 * kLength), 0.0);
  EXPECT_DOUBLE_EQ(rotationStdInGaps(one, kBegin, kBegin + 2 * kLength), 0.25 * dt);
}

TEST(NoiseInflation, CountsTheTimeWithoutSamples)
{
  const std::vector<NoiseInflation> two{
      {kBegin, kBegin + kLength, 0.5, 2.0},
      {kBegin + kLength, kBegin + 2 * kLength, 0.5, 2.0, InertialFault::Saturation}};
  const double dt = 1e-9 * static_cast<double>(kLength);
  EXPECT_DOUBLE_EQ(secondsInGaps(two, kBegin, kBegin + 2 * kLength), dt);
  EXPECT_DOUBLE_EQ(secondsInGaps(two, kBegin + kLength / 2, kBegin + 2 * kLength), 0.5 * dt);
  EXPECT_EQ(secondsInGaps(two, kBegin + kLength, kBegin + 2 * kLength), 0.0);
}

// Rates that are off to the same side turn the platform three times as far in three inputs.
TEST(NoiseInflation, CountsErrorsOfOneSignTogether)
{
  const ImuNoise noise;
  std::vector<NoiseInflation> turn;
  turn.reserve(3);
  for (int i = 0; i < 3; ++i)
    turn.push_back(
        {kBegin + i * kLength, kBegin + (i + 1) * kLength, 0.5, 2.0, InertialFault::Saturation,
         i + 1});
  const double dt = 1e-9 * static_cast<double>(kLength);
  double turned = 0.0, moved = 0.0;  // variances
  for (int i = 0; i < 3; ++i)
  {
    const ImuNoise grown =
        noiseBetween(noise, turn, kBegin + i * kLength, kBegin + (i + 1) * kLength);
    turned += (std::pow(grown.gyro_noise_density, 2) - std::pow(noise.gyro_noise_density, 2)) * dt;
    moved += (std::pow(grown.accel_noise_density, 2) - std::pow(noise.accel_noise_density, 2)) * dt;
  }
  EXPECT_NEAR(std::sqrt(turned), 3.0 * 0.5 * dt, 1e-12);
  EXPECT_NEAR(std::sqrt(moved), std::sqrt(3.0) * 2.0 * dt, 1e-12);
}

}  // namespace fastlio
