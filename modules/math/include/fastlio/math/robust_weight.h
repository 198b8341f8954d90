// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file robust_weight.h Graduated non-convexity with truncated least squares (Yang, Antonante,
 * Tzoumas and Carlone, "Graduated Non-Convexity for Robust Spatial Perception", RA-L 2020). */
#pragma once

#include <cmath>

namespace fastlio
{
/** The weight of a measurement on the way from a convex cost to the truncated one (eq. 14 of the
 * paper): 1 where it agrees, 0 where it is turned off.
 * \param squared_error normalized
 * \param limit of the squared error, beyond which the truncated cost turns a measurement off
 * \param mu convexity: small at the beginning; above 1, few weights are between 0 and 1 */
[[nodiscard]] inline double truncatedWeight(double squared_error, double limit, double mu)
{
  const double low = mu / (mu + 1.0) * limit, high = (mu + 1.0) / mu * limit;
  if (squared_error <= low) return 1.0;
  if (squared_error >= high) return 0.0;
  return std::sqrt(limit * mu * (mu + 1.0) / squared_error) - mu;
}

}  // namespace fastlio
