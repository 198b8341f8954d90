// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file columns.h Points that are stored as columns x, y, z of single precision. */
#pragma once

#include <fastlio/math/so3.h>

#include <cstddef>

namespace fastlio
{
template <typename Columns>
[[nodiscard]] Vec3 pointAt(const Columns& points, std::size_t i)
{
  return {
      static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
      static_cast<double>(points.z[i])};
}

}  // namespace fastlio
