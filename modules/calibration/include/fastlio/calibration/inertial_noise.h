// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inertial_noise.h Noise densities of an inertial sensor from its samples at rest, by the
 * Allan variance (IEEE Std 952-1997, annex C). */
#pragma once

#include <fastlio/filter/imu.h>

#include <vector>

namespace fastlio
{
/** A density and its standard deviation. */
struct MeasuredDensity
{
  double value = 0.0, std = 0.0;
  /** The rest determines it: to a tenth for white noise, to a half for the walk of a bias. */
  bool determined = false;
};

/** Noise of gyro or accelerometer at rest; root mean square over the axes. */
struct SensorNoise
{
  MeasuredDensity white;  //!< [unit/sqrt(Hz)]
  MeasuredDensity walk;   //!< of the bias [unit/s/sqrt(Hz)]
  /** White noise and a walk explain the scatter at all times: else the rig was not at rest. */
  bool still = false;
};

/** Noise densities by the longest rest of a recording. */
struct InertialNoise
{
  double rest_seconds = 0.0;
  SensorNoise gyro, accel;

  /** \a noise with the densities that the rest determines. */
  [[nodiscard]] ImuNoise appliedTo(const ImuNoise& noise) const;
};

/** \param samples in SI units, of ascending stamps; the longest rest among them counts */
[[nodiscard]] InertialNoise measureInertialNoise(const std::vector<ImuSample>& samples);

/** How long a rig must rest until the walk of a bias shows beside white noise [s]. */
[[nodiscard]] double restForWalk(double white_density, double walk_density);

}  // namespace fastlio
