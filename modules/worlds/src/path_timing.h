// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file path_timing.h How fast a vehicle takes a path (internal). */
#pragma once

#include <fastlio/worlds/path_builder.h>

#include <vector>

namespace fastlio
{
/** When a vehicle passes each point of a closed polyline [s]; the last element closes the loop. It
 * goes at Route::speed, and slower where Route::acceleration (positive) asks for it. */
[[nodiscard]] std::vector<double> timesAlong(const std::vector<Vec3>& points, const Route& route);

}  // namespace fastlio
