// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ray_walk.h The cells of a grid that a ray passes (internal). */
#pragma once

#include "vote_blocks.h"

#include <limits>

namespace fastlio
{
/** A part of a ray. */
struct RayPart
{
  Vec3 origin, direction;       //!< unit length
  double from = 0.0, to = 0.0;  //!< distances from the origin [m]
};

/** Walks from cell to cell (Amanatides and Woo, "A Fast Voxel Traversal Algorithm", 1987).
 * \param use (cell, where the ray enters, where it leaves it [m]) */
template <typename Use>
void walkCells(const RayPart& ray, double edge, const Use& use)
{
  if (!(ray.from < ray.to)) return;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vec3 start = ray.origin + ray.from * ray.direction;
  CellIndex cell{};
  std::array<std::int32_t, 3> step{};
  std::array<double, 3> next{}, width{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    const double d = ray.direction[axis];
    cell[a] = static_cast<std::int32_t>(std::floor(start[axis] / edge));
    step[a] = d > 0.0 ? 1 : -1;
    width[a] = d == 0.0 ? kNever : edge / std::abs(d);
    const double border = edge * (cell[a] + (d > 0.0 ? 1 : 0));
    next[a] = d == 0.0 ? kNever : (border - ray.origin[axis]) / d;
  }
  double at = ray.from;
  while (true)
  {
    const std::size_t axis =
        next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    use(cell, at, std::min(next[axis], ray.to));
    if (!(next[axis] < ray.to)) return;
    at = next[axis];
    cell[axis] += step[axis];
    next[axis] += width[axis];
  }
}

}  // namespace fastlio
