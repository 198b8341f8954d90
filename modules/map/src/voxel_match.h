// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_match.h The best plane at each point: one lookup of a block, at most three planes,
 * and as many again where one is seen from behind. */
#pragma once

#include "voxel_shards.h"
#include <fastlio/map/surface_map.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** What is seen from where. */
struct VoxelView
{
  const VoxelShards& shards;
  const VoxelGrid& grid;
  Eigen::Vector3f origin;  //!< of the beams, world frame [m]
};

/** Writes matches[first..last). */
void matchPlanes(
    const VoxelView& view, const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches);

/** Writes those matches that belong to points which have left their voxels. */
void rematchPlanes(
    const VoxelView& view, const WorldPoints& before, const WorldPoints& points, std::size_t first,
    std::size_t last, std::vector<PlaneMatch>& matches);

}  // namespace fastlio
