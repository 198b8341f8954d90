// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gravity.h Gravity as a free vector (FAST-LIO) or on a sphere of known radius (FAST-LIO2).
 */
#pragma once

#include <fastlio/filter/state.h>

namespace fastlio
{
/** How gravity is part of the state. */
enum class GravityModel
{
  Free,   //!< any vector of R^3, as in the paper
  Sphere  //!< direction only, the length is known
};

/** The state with gravity brought back to the given length [m/s^2], and without uncertainty of the
 * length: to first order an update on the sphere S^2, whose tangent space is the plane across g. */
[[nodiscard]] FilterState withGravityOnSphere(const FilterState& state, double length);

}  // namespace fastlio
