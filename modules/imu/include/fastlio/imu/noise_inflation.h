// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file noise_inflation.h Spans of time in which inertial data are worse than their noise says:
 * gaps, clipped samples, gated samples. */
#pragma once

#include <fastlio/filter/imu.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Why inertial data are worse than their noise says. */
enum class InertialFault
{
  Gap,         //!< no samples
  Saturation,  //!< clipped at the end of the sensor's range
  Spike        //!< an absurd sample was left out
};

/** In a span of time the inputs are off by an error that is constant over each of them. */
struct NoiseInflation
{
  std::int64_t begin_ns = 0, end_ns = 0;
  double gyro_std = 0.0;   //!< of the angular rate [rad/s]
  double accel_std = 0.0;  //!< of the specific force [m/s^2]
  InertialFault fault = InertialFault::Gap;
  int in_a_row = 1;  //!< inputs up to this one whose rates share one error
};

/** The noise densities of an input that holds from begin_ns to end_ns: an error sigma that is
 * constant over dt is like white noise of the density sigma sqrt(dt). Without an inflation in that
 * time, \a noise to the bit. */
[[nodiscard]] ImuNoise noiseBetween(
    const ImuNoise& noise, const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns,
    std::int64_t end_ns);

/** Standard deviation of the rotation from begin_ns to end_ns by samples that are missing [rad]. */
[[nodiscard]] double rotationStdInGaps(
    const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns, std::int64_t end_ns);

/** Time from begin_ns to end_ns without samples [s]. */
[[nodiscard]] double secondsInGaps(
    const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns, std::int64_t end_ns);

/** Fraction of [begin_ns, end_ns] with inflated noise, 0 to 1. */
[[nodiscard]] double inflatedRatio(
    const std::vector<NoiseInflation>& inflations, std::int64_t begin_ns, std::int64_t end_ns);

}  // namespace fastlio
