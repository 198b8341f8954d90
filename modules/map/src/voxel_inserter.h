// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_inserter.h Adds the points of scans to voxels, several blocks at a time. */
#pragma once

#include "voxel_shards.h"
#include <fastlio/map/surface_map.h>
#include <fastlio/parallel/workers.h>

#include <array>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Values that are the same for all points of an insertion. */
struct InsertionContext
{
  const VoxelGrid& grid;
  const PlaneRules& rules;
  Eigen::Vector3f origin;  //!< of the beams, world frame [m]
  std::uint32_t scan = 0;  //!< number of this insertion, from 1
  bool from_new_view = true;
};

/** Holds what insertions reuse. The points of a shard are added in their order, by one thread. */
class VoxelInserter
{
 public:
  void insert(
      const WorldPoints& points, const InsertionContext& context, const Workers& workers,
      VoxelShards& shards);

 private:
  /** A point that is being inserted. */
  struct Arrival
  {
    std::uint32_t point = 0;
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

  /** The storage of one thread. */
  struct Bench
  {
    std::vector<Arrival> arrivals;
    std::vector<Refit> refits;
  };

  /** Which of the points in by_shard_ are a shard's. */
  struct Range
  {
    std::size_t first = 0, last = 0;
  };

  void sortByShard(const WorldPoints& points, const VoxelGrid& grid, const Workers& workers);
  static void findVoxels(std::vector<Arrival>& arrivals, VoxelStorage& storage);
  static std::uint32_t otherSideOf(
      const Arrival& arrival, std::size_t scale, VoxelStorage& storage);
  static void addPoint(
      const Arrival& arrival, const WorldPoints& points, const InsertionContext& context,
      VoxelStorage& storage, std::vector<Refit>& refits);
  void insertShard(
      std::uint8_t shard, const WorldPoints& points, const InsertionContext& context,
      VoxelStorage& storage);

  std::vector<std::uint8_t> shard_of_;   // per point
  std::vector<std::uint32_t> by_shard_;  // points, shard by shard
  std::array<Range, VoxelShards::kCount> ranges_;
  std::array<Bench, VoxelShards::kCount> benches_;
};

}  // namespace fastlio
