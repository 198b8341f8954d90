// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file local_points.h The neighbours of a query as the fits of planes and lines take them. */
#pragma once

#include <fastlio/map/neighbors.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace fastlio
{
/** Points of a query's neighbours, relative to the query so that single precision loses nothing. */
struct LocalPoints
{
  std::array<Eigen::Vector3d, kMaxNeighbors> items;
  std::size_t count = 0;

  [[nodiscard]] const Eigen::Vector3d* begin() const { return items.data(); }
  [[nodiscard]] const Eigen::Vector3d* end() const { return items.data() + count; }
};

inline LocalPoints localPoints(const NeighborSet& neighbors, float x, float y, float z)
{
  LocalPoints local;
  for (const Neighbor& n : neighbors)
    local.items[local.count++] = {
        static_cast<double>(n.x) - x, static_cast<double>(n.y) - y, static_cast<double>(n.z) - z};
  return local;
}

}  // namespace fastlio
