// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file start_in_map.h What a start in a map needs, in the middle of a run. */
#pragma once

#include <fastlio/odometry/odometry.h>
#include <fastlio/slam/CLidarInertialOdometry.h>

namespace fastlio
{
/** A copy of the map in use. */
[[nodiscard]] SavedMap savedMapOf(const Odometry& odometry);

/** \exception std::invalid_argument the pose is not finite, or a standard deviation out of range */
void requireUsable(const VehicleGuess& guess);

}  // namespace fastlio
