// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file robust_kernel.h Weights that make the update (eq. 15-20) trust large residuals less. */
#pragma once

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

}  // namespace fastlio
