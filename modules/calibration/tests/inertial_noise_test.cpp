// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/calibration/inertial_noise.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
constexpr double kPeriod = 0.005;  // [s]
constexpr ImuNoise kTrue{3e-4, 4e-3, 1e-4, 1e-3};

/** Samples of a sensor that lies still, with white noise and biases that walk. */
std::vector<ImuSample> samplesAtRest(double seconds, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto noise = [&](double std)
  { return Vec3(std * Vec3::NullaryExpr([&] { return normal(random); })); };
  const double per_root = 1.0 / std::sqrt(kPeriod), root = std::sqrt(kPeriod);
  Vec3 gyro_bias(0.01, -0.02, 0.005), accel_bias(0.05, 0.0, -0.1);
  std::vector<ImuSample> samples;
  for (int i = 0; i < static_cast<int>(seconds / kPeriod); ++i)
  {
    ImuSample& sample = samples.emplace_back();
    sample.stamp_ns = 1'000'000'000 + static_cast<std::int64_t>(i) * 5'000'000;
    sample.gyro = gyro_bias + noise(kTrue.gyro_noise_density * per_root);
    sample.accel = Vec3(0.0, 0.0, 9.81) + accel_bias + noise(kTrue.accel_noise_density * per_root);
    gyro_bias += noise(kTrue.gyro_bias_walk * root);
    accel_bias += noise(kTrue.accel_bias_walk * root);
  }
  return samples;
}

TEST(InertialNoise, FindsAllDensitiesInALongRest)
{
  const InertialNoise noise = measureInertialNoise(samplesAtRest(120.0, 1));
  EXPECT_NEAR(noise.rest_seconds, 120.0, 1.0);
  ASSERT_TRUE(noise.gyro.white.determined && noise.accel.white.determined);
  ASSERT_TRUE(noise.gyro.walk.determined && noise.accel.walk.determined);
  const ImuNoise found = noise.appliedTo(ImuNoise{});
  EXPECT_NEAR(found.gyro_noise_density, kTrue.gyro_noise_density, 0.05 * 3e-4);
  EXPECT_NEAR(found.accel_noise_density, kTrue.accel_noise_density, 0.05 * 4e-3);
  EXPECT_NEAR(found.gyro_bias_walk, kTrue.gyro_bias_walk, 0.5 * 1e-4);
  EXPECT_NEAR(found.accel_bias_walk, kTrue.accel_bias_walk, 0.5 * 1e-3);
}

// Over many rests the errors are as large as the standard deviations.
TEST(InertialNoise, StandardDeviationsAreTrue)
{
  double squares = 0.0, count = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    const InertialNoise noise = measureInertialNoise(samplesAtRest(10.0, seed));
    squares +=
        std::pow((noise.gyro.white.value - kTrue.gyro_noise_density) / noise.gyro.white.std, 2);
    squares +=
        std::pow((noise.accel.white.value - kTrue.accel_noise_density) / noise.accel.white.std, 2);
    count += 2.0;
  }
  EXPECT_GT(squares / count, 0.4);
  EXPECT_LT(squares / count, 1.8);
}

TEST(InertialNoise, AShortRestTellsTheWhiteNoiseOnly)
{
  const InertialNoise noise = measureInertialNoise(samplesAtRest(6.0, 2));
  EXPECT_TRUE(noise.gyro.white.determined);
  EXPECT_FALSE(noise.gyro.walk.determined);
  const ImuNoise found = noise.appliedTo(ImuNoise{});
  EXPECT_NE(found.gyro_noise_density, ImuNoise{}.gyro_noise_density);
  EXPECT_EQ(found.gyro_bias_walk, ImuNoise{}.gyro_bias_walk);
  // The larger the walk beside the noise, the sooner it shows.
  const double needed = restForWalk(kTrue.gyro_noise_density, kTrue.gyro_bias_walk);
  EXPECT_GT(needed, 6.0);
  EXPECT_LT(needed, 120.0);
  EXPECT_GT(restForWalk(kTrue.gyro_noise_density, 0.1 * kTrue.gyro_bias_walk), 5.0 * needed);
}

TEST(InertialNoise, MotionIsNotTakenForNoise)
{
  std::vector<ImuSample> samples = samplesAtRest(20.0, 3);
  for (ImuSample& sample : samples)  // as in a hand that is held still
    sample.gyro.x() += 4e-3 * std::sin(2.0 * M_PI * 2e-9 * static_cast<double>(sample.stamp_ns));
  const InertialNoise noise = measureInertialNoise(samples);
  EXPECT_FALSE(noise.gyro.still);
  EXPECT_FALSE(noise.gyro.white.determined || noise.gyro.walk.determined);
  EXPECT_EQ(noise.appliedTo(ImuNoise{}).gyro_noise_density, ImuNoise{}.gyro_noise_density);
}

TEST(InertialNoise, NothingComesFromNothing)
{
  EXPECT_EQ(measureInertialNoise({}).rest_seconds, 0.0);
  std::vector<ImuSample> constant = samplesAtRest(3.0, 4);
  for (ImuSample& sample : constant)
    sample.gyro.setZero();
  const InertialNoise noise = measureInertialNoise(constant);
  EXPECT_FALSE(noise.gyro.white.determined) << "a sensor that does not move a bit shows nothing";
}
}  // namespace
}  // namespace fastlio
