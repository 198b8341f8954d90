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
/** A propagated state, and how the way to it passes errors on. */
struct Prediction
{
  FilterState state;
  ErrorTransition transition;
};

/** Eq. 4-8 through inputs that hold until end_ns; \a visit(stamp_ns, prediction) after each step.
 * \param inflations spans of time in which the inputs are worse than \a noise says */
template <typename Visit>
Prediction propagateThrough(
    const FilterState& from, const std::vector<ImuSample>& inputs, std::int64_t end_ns,
    const ImuNoise& noise, const std::vector<NoiseInflation>& inflations, const Visit& visit)
{
  Prediction p;
  p.state = from;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs.size() ? inputs[i + 1].stamp_ns : end_ns;
    const double dt = toSeconds(stop_ns - inputs[i].stamp_ns);
    const Vec3 &gyro = inputs[i].gyro, &accel = inputs[i].accel;
    p.transition = chain(p.transition, p.state.x, gyro, accel, dt);
    p.state = propagate(
        p.state, gyro, accel, dt, noiseBetween(noise, inflations, inputs[i].stamp_ns, stop_ns));
    visit(stop_ns, p);
  }
  return p;
}

}  // namespace fastlio
