// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/noise_measurement.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
constexpr std::int64_t kPeriodNs = 5'000'000;
const ImuNoise kSensor{5e-4, 5e-3, 2e-5, 2e-4};

/** Samples of a shaken hand, with white noise of the given densities. */
NoiseMeasurement measured(double gyro_density, double accel_density, int samples)
{
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  const double root_rate = std::sqrt(200.0);
  NoiseMeasurement measurement;
  for (int i = 0; i < samples; ++i)
  {
    const double t = 0.005 * i;
    ImuSample sample;
    sample.stamp_ns = i * kPeriodNs;
    for (int axis = 0; axis < 3; ++axis)
    {
      sample.gyro[axis] =
          8.0 * std::sin(12.0 * t + axis) + gyro_density * root_rate * normal(engine);
      sample.accel[axis] =
          15.0 * std::cos(15.0 * t + axis) + accel_density * root_rate * normal(engine);
    }
    measurement.add(sample);
  }
  return measurement;
}
}  // namespace

TEST(SampleScatter, IsTheDensityOfAllSamples)
{
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  SampleScatter scatter;
  EXPECT_EQ(scatter.gyroDensity(), 0.0);
  for (int i = 0; i < 4000; ++i)
  {
    if (i % 500 == 499) continue;  // a missing sample is no scatter
    const double t = 0.005 * i, scale = std::sqrt(200.0) * (i < 2000 ? 1.0 : 3.0);
    ImuSample sample;
    sample.stamp_ns = 1 + i * kPeriodNs;
    for (int axis = 0; axis < 3; ++axis)
    {
      sample.gyro[axis] = 2.0 * t + 8.0 * std::sin(6.0 * t) + 0.002 * scale * normal(engine);
      sample.accel[axis] = 9.8 + 0.05 * scale * normal(engine);
    }
    scatter.add(sample);
  }
  EXPECT_NEAR(scatter.duration(), 20.0, 0.02);
  // The mean of the squares of 1 and 3 is 5.
  EXPECT_NEAR(scatter.gyroDensity(), 0.002 * std::sqrt(5.0), 2e-4);
  EXPECT_NEAR(scatter.accelDensity(), 0.05 * std::sqrt(5.0), 5e-3);
}

TEST(NoiseMeasurement, CountsAThirdOfWhatItSees)
{
  const ImuNoise noise = measured(6e-3, 0.09, 400).atLeast(kSensor);
  EXPECT_NEAR(noise.gyro_noise_density, 2e-3, 5e-4);
  EXPECT_NEAR(noise.accel_noise_density, 0.03, 0.008);
  EXPECT_EQ(noise.gyro_bias_walk, kSensor.gyro_bias_walk);
}

TEST(NoiseMeasurement, MotionIsNoNoise)
{
  const ImuNoise noise = measured(5e-4, 5e-3, 400).atLeast(kSensor);
  EXPECT_EQ(noise.gyro_noise_density, kSensor.gyro_noise_density);
  EXPECT_EQ(noise.accel_noise_density, kSensor.accel_noise_density);
}

TEST(NoiseMeasurement, FewSamplesTellNothing)
{
  EXPECT_EQ(
      measured(1.0, 10.0, 20).atLeast(kSensor).gyro_noise_density, kSensor.gyro_noise_density);
}

TEST(NoiseMeasurement, AGapIsNoNoise)
{
  NoiseMeasurement measurement;
  std::int64_t stamp = 0;
  for (int i = 0; i < 400; ++i)
  {
    stamp += i % 10 == 0 ? 20 * kPeriodNs : kPeriodNs;
    ImuSample sample;
    sample.stamp_ns = stamp;
    sample.gyro.setConstant(std::floor(0.1 * i));  // jumps in every gap
    measurement.add(sample);
  }
  EXPECT_EQ(measurement.atLeast(kSensor).gyro_noise_density, kSensor.gyro_noise_density);
}

}  // namespace fastlio
