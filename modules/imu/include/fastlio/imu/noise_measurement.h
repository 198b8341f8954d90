// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file noise_measurement.h The noise that inertial samples have, by how they scatter from one to
 * the next: vibration of the platform is often more than the sensor's noise in its datasheet. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/math/time.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace fastlio
{
/** Noise of one axis of a sample, as the square of its density. */
struct SampleNoise
{
  double gyro = 0.0;   //!< [rad^2/s^2/Hz]
  double accel = 0.0;  //!< [m^2/s^4/Hz]
};

/** Third differences of samples, which leave nothing of a motion that changes slowly against the
 * rate. Of white noise with the variance s^2, the variance of
 * a_i - 3 a_{i-1} + 3 a_{i-2} - a_{i-3} is 20 s^2. */
class ThirdDifferences
{
 public:
  /** \return the measure of the last four samples: nothing when one is missing among them */
  [[nodiscard]] std::optional<SampleNoise> add(const ImuSample& sample);

 private:
  std::array<ImuSample, 3> before_;  //!< the latest first
  std::size_t known_ = 0;            //!< of them
};

/** The noise that samples have had lately. */
class NoiseMeasurement
{
 public:
  /** Takes the next sample. */
  void add(const ImuSample& sample);

  /** \a noise, with densities at least as large as a third of those measured lately. Vibration is
   * no white noise: what it adds to one sample it takes from others, so that less of it is left
   * over a scan. The smaller the share, the better among bushes and trees, whose scans
   * err more than they say; the larger, the better on vehicles. Without vibration, the noise to the
   * bit. */
  [[nodiscard]] ImuNoise atLeast(const ImuNoise& noise) const;

 private:
  ThirdDifferences differences_;
  SampleNoise mean_;
  double count_ = 0.0;
};

/** The noise that all samples have had, and for how long. */
class SampleScatter
{
 public:
  /** Takes the next sample. */
  void add(const ImuSample& sample);

  [[nodiscard]] double duration() const { return toSeconds(last_ns_ - first_ns_); }  //!< [s]
  [[nodiscard]] double gyroDensity() const { return density(sum_.gyro); }    //!< [rad/s/sqrt(Hz)]
  [[nodiscard]] double accelDensity() const { return density(sum_.accel); }  //!< [m/s^2/sqrt(Hz)]

 private:
  [[nodiscard]] double density(double sum) const
  {
    return count_ > 0 ? std::sqrt(sum / count_) : 0;
  }

  ThirdDifferences differences_;
  SampleNoise sum_;
  double count_ = 0.0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
};

}  // namespace fastlio
