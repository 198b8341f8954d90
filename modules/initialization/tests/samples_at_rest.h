// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file samples_at_rest.h Samples of an IMU that rests, with noise. */
#pragma once

#include <fastlio/initialization/static_initializer.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace fastlio
{
inline constexpr int kSamples = 400;
inline constexpr double kGyroNoise = 0.003, kAccelNoise = 0.03;

class Random
{
 public:
  explicit Random(unsigned seed) : rng_(seed) {}
  double normal(double sigma) { return sigma * normal_(rng_); }
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }
  Vec3 vector(double sigma) { return {normal(sigma), normal(sigma), normal(sigma)}; }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/** The truth about a resting IMU, in its own frame. */
struct RestTruth
{
  Vec3 gyro_bias, accel_bias, g;
};

inline RestTruth drawTruth(const InitializationOptions& p, Random& random)
{
  RestTruth truth;
  truth.gyro_bias = random.vector(0.01);
  truth.accel_bias = random.vector(p.accel_bias_std);
  truth.g = random.vector(1.0).normalized() * (p.gravity + random.normal(kGravityStd));
  return truth;
}

inline std::vector<ImuSample> samplesAtRest(const RestTruth& truth, Random& random)
{
  std::vector<ImuSample> samples;
  samples.reserve(kSamples);
  for (std::int64_t i = 0; i < kSamples; ++i)
    samples.push_back(
        {5'000'000 * i, truth.gyro_bias + random.vector(kGyroNoise),
         truth.accel_bias - truth.g + random.vector(kAccelNoise)});
  return samples;
}

/** The same beside an engine. */
inline std::vector<ImuSample> samplesWithAnEngine(const RestTruth& truth, Random& random)
{
  std::vector<ImuSample> samples = samplesAtRest(truth, random);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i].accel.z() += 2.0 * std::sin(0.9 * static_cast<double>(i));
  return samples;
}

}  // namespace fastlio
