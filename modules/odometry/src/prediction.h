// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file prediction.h Forward propagation through the inertial samples of a scan (eq. 4-8). */
#pragma once

#include <fastlio/filter/propagation.h>
#include <fastlio/imu/noise_inflation.h>
#include <fastlio/math/time.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Eq. 4-8 through inputs that hold until end_ns; \a visit(stamp_ns, prediction) after each step.
 * \param inflations spans of time in which the inputs are worse than \a noise says */
template <typename Visit>
Prediction propagateThrough(
    const FilterState& from, const std::vector<ImuSample>& inputs, std::int64_t end_ns,
    const ImuNoise& noise, const std::vector<NoiseInflation>& inflations, const Visit& visit)
{
  Prediction p{from, {}};
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs.size() ? inputs[i + 1].stamp_ns : end_ns;
    const double dt = toSeconds(stop_ns - inputs[i].stamp_ns);
    p = propagate(
        p, inputs[i].gyro, inputs[i].accel, dt,
        noiseBetween(noise, inflations, inputs[i].stamp_ns, stop_ns));
    visit(stop_ns, p);
  }
  return p;
}

}  // namespace fastlio
