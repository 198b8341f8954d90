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

}  // namespace fastlio
