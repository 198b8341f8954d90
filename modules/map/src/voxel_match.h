// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_match.h The best plane at each point: one lookup of a block, at most three planes.
 */
#pragma once

#include "voxel_shards.h"
#include <fastlio/map/surface_map.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** Writes matches[first..last). */
void matchPlanes(
    const VoxelShards& shards, const VoxelGrid& grid, const WorldPoints& points, std::size_t first,
    std::size_t last, std::vector<PlaneMatch>& matches);

/** Writes those matches that belong to points which have left their voxels. */
void rematchPlanes(
    const VoxelShards& shards, const VoxelGrid& grid, const WorldPoints& before,
    const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches);

}  // namespace fastlio
