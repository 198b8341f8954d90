// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gravity.h Gravity as a free vector (FAST-LIO) or on a sphere of known radius (FAST-LIO2).
 */
#pragma once

namespace fastlio
{
/** How gravity is part of the state. */
enum class GravityModel
{
  Free,   //!< any vector of R^3, as in the paper
  Sphere  //!< direction only, the length is known
};

}  // namespace fastlio
