// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plain_zero.h Numbers for people: no "-0.00". */
#pragma once

#include <cmath>

namespace fastlio
{
/** \a value, or 0 where so many \a decimals would show nothing of it but its sign. */
[[nodiscard]] inline double plainZero(double value, int decimals)
{
  return std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
}

}  // namespace fastlio
