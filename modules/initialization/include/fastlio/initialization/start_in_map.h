// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file start_in_map.h The first state in a map that is there already, and the search for it. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/interface/odometry_options.h>

#include <vector>

namespace fastlio
{
/** The state at another pose in the map. How gravity and velocity lie in the body does not depend
 * on where the map's axes point: they turn with the body, and so does what is known of them. */
[[nodiscard]] FilterState standingAt(const FilterState& state, const Pose& T_map_imu);

/** The state moved to a place and heading in the map; roll and pitch stay as gravity gives them. */
[[nodiscard]] FilterState placedInMap(const FilterState& start, const Pose& T_map_imu);

/** As uncertain about place and heading as the parameters say, and about roll and pitch as the
 * biases leave them open. An error of the map's axes turns attitude, velocity and gravity together,
 * so that the correction by the scan leaves gravity as it is in the body.
 * \param scale of these variances */
[[nodiscard]] FilterState withUncertainPlace(
    const FilterState& state, const InitializationOptions& parameters, double scale);

/** Places and headings around a pose, as far as their standard deviations reach: itself first. */
[[nodiscard]] std::vector<Pose> posesAround(
    const Pose& pose, const InitializationOptions& parameters);

}  // namespace fastlio
