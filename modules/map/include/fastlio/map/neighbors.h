// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file neighbors.h Outcome of a k-nearest-neighbour query, without heap storage. */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** A map point found by a query. */
struct Neighbor
{
  float x = 0, y = 0, z = 0;      //!< the point, map frame [m]
  float distance_sqr = 0;         //!< squared distance to the query [m^2]
  std::uint32_t point_index = 0;  //!< index of the point in the map's buffers
};

/** Most neighbours that a NeighborSet can hold. */
constexpr std::size_t kMaxNeighbors = 16;

/** Neighbours in ascending order of (distance, point_index). */
struct NeighborSet
{
  std::array<Neighbor, kMaxNeighbors> items;
  std::size_t count = 0;

  [[nodiscard]] std::size_t size() const { return count; }
  [[nodiscard]] bool empty() const { return count == 0; }
  [[nodiscard]] const Neighbor& operator[](std::size_t i) const { return items[i]; }
  [[nodiscard]] const Neighbor* begin() const { return items.data(); }
  [[nodiscard]] const Neighbor* end() const { return items.data() + count; }
};

}  // namespace fastlio
