// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file planar_error.h How far the map of a planar SLAM is from the truth. */
#pragma once

#include <fastlio/simulation/simulation.h>

#include <mrpt/maps/CSimpleMap.h>

namespace fastlio::testing
{
/** Where the points of the keyframes' planar scans are, against where they are with the true
 * poses, both seen from the first keyframe. */
struct PlanarError
{
  double rms = 0.0;      //!< over all points [m]
  double largest = 0.0;  //!< [m]
  std::size_t key_frames = 0, points = 0;
};

[[nodiscard]] PlanarError planarError(
    const mrpt::maps::CSimpleMap& map, const Simulation& simulation);

}  // namespace fastlio::testing
