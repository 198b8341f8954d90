// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file surface_distance.h How far a point is from the surfaces of a world: formulas of their own,
 * not those that rays are cast with. */
#pragma once

#include <fastlio/worlds/world.h>

namespace fastlio::testing
{
/** Distance of a point to the surface of a primitive [m]. */
[[nodiscard]] double surfaceDistance(const Primitive& primitive, const Vec3& point);

/** Least distance to any surface of a world at t; to the ground measured vertically. */
[[nodiscard]] double surfaceDistance(const World& world, const Vec3& point, double t);

}  // namespace fastlio::testing
