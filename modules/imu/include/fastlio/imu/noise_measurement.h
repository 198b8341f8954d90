// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file noise_measurement.h The noise that inertial samples have, by how they scatter from one to
 * the next: vibration of the platform is often more than what the datasheet tells of the sensor. */
#pragma once

#include <fastlio/filter/imu.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** Measures the noise of samples by their third differences, which leave nothing of a motion that
 * changes slowly against the rate. Of white noise with the variance s^2, the variance of
 * a_i - 3 a_{i-1} + 3 a_{i-2} - a_{i-3} is 20 s^2. */
class NoiseMeasurement
{
 public:
  /** Takes the next sample. */
  void add(const ImuSample& sample);

  /** \a noise, with densities at least as large as a third of those measured lately. Vibration is
   * no white noise: what it adds to one sample it takes from others, so that less of it is left
   * over a scan. Between a quarter and a half, errors and covariances of shaken sensors hardly
   * depend on the share. Without vibration, the noise to the bit. */
  [[nodiscard]] ImuNoise atLeast(const ImuNoise& noise) const;

 private:
  std::array<ImuSample, 3> before_;  //!< the latest first
  std::size_t known_ = 0;            //!< of them
  double gyro_variance_ = 0.0;   //!< of a sample's axis, over its time: density^2 [rad^2/s^2/Hz]
  double accel_variance_ = 0.0;  //!< likewise [m^2/s^4/Hz]
  double count_ = 0.0;
};

}  // namespace fastlio
