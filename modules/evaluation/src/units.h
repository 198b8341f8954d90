// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file units.h From the units of the library to those of reports. */
#pragma once

#include <fastlio/math/angles.h>

namespace fastlio
{
[[nodiscard]] inline double toDegrees(double radians)
{
  return radians * 180.0 / kPi;
}
[[nodiscard]] inline double toPercent(double ratio)
{
  return 100.0 * ratio;
}

}  // namespace fastlio
