// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/noise_measurement.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kCountedFraction = 1.0 / 3.0;  // of the measured density that counts
constexpr double kMemory = 50.0;                // samples that an estimate averages over
constexpr double kLeast = 20.0;                 // fewer say nothing
// Third differences of three axes: their mean square over the variance of one axis.
constexpr double kGain = 3.0 * 20.0;
constexpr double kMostUnevenSpacing = 1.8;  // beyond it, a sample is missing
}  // namespace

std::optional<SampleNoise> ThirdDifferences::add(const ImuSample& sample)
{
  const auto b = before_;
  const bool complete = known_ == before_.size();
  before_ = {sample, b[0], b[1]};
  known_ = std::min(known_ + 1, before_.size());
  if (!complete) return std::nullopt;
  const double dt = toSeconds(sample.stamp_ns - b[0].stamp_ns);
  const double mean_dt = toSeconds(b[0].stamp_ns - b[2].stamp_ns) / 2.0;
  if (dt > kMostUnevenSpacing * mean_dt)
  {
    known_ = 1;
    return std::nullopt;
  }
  const Vec3 gyro = sample.gyro - 3.0 * (b[0].gyro - b[1].gyro) - b[2].gyro;
  const Vec3 accel = sample.accel - 3.0 * (b[0].accel - b[1].accel) - b[2].accel;
  return SampleNoise{gyro.squaredNorm() / kGain * mean_dt, accel.squaredNorm() / kGain * mean_dt};
}

void NoiseMeasurement::add(const ImuSample& sample)
{
  const auto noise = differences_.add(sample);
  if (!noise) return;
  count_ = std::min(count_ + 1.0, kMemory);
  mean_.gyro += (noise->gyro - mean_.gyro) / count_;
  mean_.accel += (noise->accel - mean_.accel) / count_;
}

void SampleScatter::add(const ImuSample& sample)
{
  if (first_ns_ == 0) first_ns_ = sample.stamp_ns;
  last_ns_ = sample.stamp_ns;
  const auto noise = differences_.add(sample);
  if (!noise) return;
  count_ += 1.0;
  sum_.gyro += noise->gyro;
  sum_.accel += noise->accel;
}

ImuNoise NoiseMeasurement::atLeast(const ImuNoise& noise) const
{
  ImuNoise grown = noise;
  if (count_ < kLeast) return grown;
  grown.gyro_noise_density =
      std::max(noise.gyro_noise_density, kCountedFraction * std::sqrt(mean_.gyro));
  grown.accel_noise_density =
      std::max(noise.accel_noise_density, kCountedFraction * std::sqrt(mean_.accel));
  return grown;
}

}  // namespace fastlio
