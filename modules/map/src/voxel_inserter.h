// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_inserter.h Adds the points of scans to voxels, several blocks at a time. */
#pragma once

#include "voxel_storage.h"
#include <fastlio/map/surface_map.h>
#include <fastlio/parallel/workers.h>

#include <array>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Holds what insertions reuse.
 *
 * Blocks and voxels are numbered in the order of the points, by one thread; a block's points are
 * added in their order, by one thread: the map does not depend on how many there are. */
class VoxelInserter
{
 public:
  /** \param origin of the beams, world frame [m] \param scan number of this insertion, from 1 */
  void insert(
      const WorldPoints& points, const Eigen::Vector3f& origin, const VoxelGrid& grid,
      const PlaneRules& rules, std::uint32_t scan, const Workers& workers, VoxelStorage& storage);

 private:
  /** A point of the scan that is being inserted. */
  struct Arrival
  {
    VoxelAddress address;
    std::uint32_t block = VoxelStorage::kNoBlock;
    std::array<std::uint32_t, kVoxelScales> voxels{};
  };

  /** A voxel to fit and where it is. */
  struct Refit
  {
    std::uint32_t voxel = 0;
    std::uint8_t slot = 0;
    std::uint64_t block_key = 0;
  };

  /** The points of a share of the blocks, and the voxels there to fit: one thread's work. */
  struct Shard
  {
    std::vector<std::uint32_t> points;
    std::vector<Refit> refits;
  };

  static constexpr std::size_t kShards = 16;

  void locate(
      const WorldPoints& points, const VoxelGrid& grid, const VoxelStorage& storage,
      std::size_t first, std::size_t last);
  static void makeRoom(Arrival& arrival, VoxelStorage& storage);
  void distribute(VoxelStorage& storage);
  void addPoint(
      std::uint32_t i, const WorldPoints& points, const Eigen::Vector3f& origin,
      const VoxelGrid& grid, VoxelStorage& storage, std::vector<Refit>& refits) const;

  std::vector<Arrival> arrivals_;
  std::array<Shard, kShards> shards_;
};

}  // namespace fastlio
