// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ray_bundle.h Rays from one point that are cast together. */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <array>
#include <cstddef>
#include <optional>

namespace fastlio
{
/** Rays from one point. Nearly parallel ones meet the same bodies, and share the search for them.
 */
struct RayBundle
{
  static constexpr std::size_t kMost = 6;

  explicit RayBundle(const Ray& first) : origin(first.origin) { directions[0] = first.direction; }

  Vec3 origin;
  std::array<Vec3, kMost> directions;  //!< of unit length; the first count are used
  std::size_t count = 1;

  [[nodiscard]] Ray ray(std::size_t i) const { return {origin, directions[i]}; }

  /** All rays go the same way along each axis: they meet the sides of a box in one order. */
  [[nodiscard]] bool isOfOneOctant() const
  {
    for (std::size_t i = 1; i < count; ++i)
      if (((directions[i].array() < 0.0) != (directions[0].array() < 0.0)).any()) return false;
    return true;
  }
};

/** What each ray of a bundle meets first. */
using BundleHits = std::array<std::optional<RayHit>, RayBundle::kMost>;

}  // namespace fastlio
