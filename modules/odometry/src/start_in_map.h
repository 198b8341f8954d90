// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file start_in_map.h The first state in a map that is there already, and the search for it. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/odometry/parameters.h>

#include <vector>

namespace fastlio
{
/** The state moved to a place and heading in the map, with their uncertainty; roll and pitch stay
 * as gravity tells them, give or take what the biases leave open. */
[[nodiscard]] FilterState placedInMap(
    const FilterState& start, const Pose& T_map_imu, const InitializationParameters& parameters);

/** Places and headings around the state, as far as their standard deviations reach: the state
 * itself first. */
[[nodiscard]] std::vector<FilterState> candidatesAround(
    const FilterState& state, const InitializationParameters& parameters);

}  // namespace fastlio
