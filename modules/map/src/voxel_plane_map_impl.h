// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_plane_map_impl.h The data of a VoxelPlaneMap. */
#pragma once

#include "voxel_inserter.h"
#include "voxel_match.h"
#include "voxel_shards.h"
#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/math/pose.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace fastlio
{
class VoxelPlaneMap::Impl
{
 public:
  VoxelPlaneOptions options;
  std::shared_ptr<const Workers> workers;
  VoxelGrid grid;
  VoxelShards shards = {};
  VoxelInserter inserter = {};
  std::uint32_t scan = 0;         //!< insertions so far
  std::optional<Pose> view = {};  //!< the latest new one, of the sensor in the world
  /** Per shard, the block that removeOutside() looked at last. */
  std::array<std::uint32_t, VoxelShards::kCount> sweep{};

  void insert(const WorldPoints& points, const Vec3& sensor_origin, bool from_new_view);
  [[nodiscard]] VoxelView seenFrom(const Vec3& sensor_origin) const
  {
    return {shards, grid, sensor_origin.cast<float>()};
  }
};

}  // namespace fastlio
