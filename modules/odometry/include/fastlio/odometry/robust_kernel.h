// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file robust_kernel.h Weights that make the update (eq. 15-20) trust large residuals less. */
#pragma once

#include <cmath>

namespace fastlio
{
/** A kernel rho of the residual r in standard deviations; its weight is rho'(r) / r. */
enum class RobustKernel
{
  None,          //!< least squares: all residuals within the gate weigh alike
  Huber,         //!< min(1, k/|r|): large residuals pull with a constant force
  Cauchy,        //!< 1/(1 + (r/k)^2)
  GemanMcClure,  //!< 1/(1 + (r/k)^2)^2: large residuals hardly pull at all
};

/** Weight of a residual, 1 at zero. \param normalized_square r^2 = z^2 / variance
 * \param scale k, in standard deviations, positive */
[[nodiscard]] inline double robustWeight(
    RobustKernel kernel, double normalized_square, double scale)
{
  const double x = normalized_square / (scale * scale);
  switch (kernel)
  {
    case RobustKernel::None:
      break;
    case RobustKernel::Huber:
      return x <= 1.0 ? 1.0 : 1.0 / std::sqrt(x);
    case RobustKernel::Cauchy:
      return 1.0 / (1.0 + x);
    case RobustKernel::GemanMcClure:
      return 1.0 / ((1.0 + x) * (1.0 + x));
  }
  return 1.0;
}

}  // namespace fastlio
