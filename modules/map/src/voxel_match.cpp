// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_match.h"

#include <algorithm>

namespace fastlio
{
namespace
{
// Blocks, voxels and planes of so many points are fetched into the cache together: most of them
// come from the memory, and waiting for one at a time would take most of the time.
constexpr std::size_t kBatch = 32;

/** A point on its way to its plane. */
struct Query
{
  VoxelAddress address;
  std::uint8_t shard = 0;
  const VoxelBlock* block = nullptr;
  std::array<std::uint32_t, kVoxelScales> voxels{};
};

using Batch = std::array<Query, kBatch>;

// No block has it: keys have fewer bits.
constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

void findBlocks(
    const VoxelShards& shards, const VoxelGrid& grid, const WorldPoints& points, std::size_t first,
    std::size_t count, Batch& batch)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    Query& query = batch[i];
    const float x = points.x[first + i], y = points.y[first + i], z = points.z[first + i];
    if (!grid.contains(x, y, z))  // nor is a NaN anywhere
    {
      query.address.block_key = kNowhere;
      query.block = nullptr;
      continue;
    }
    query.address = grid.addressOf(x, y, z);
    // Neighbours in the scan mostly share the block.
    if (i > 0 && batch[i - 1].address.block_key == query.address.block_key)
    {
      query.block = batch[i - 1].block;
      query.shard = batch[i - 1].shard;
    }
    else
    {
      query.shard = VoxelShards::shardOf(query.address.block_key);
      const VoxelStorage& storage = shards[query.shard];
      const std::uint32_t number = storage.find(query.address.block_key);
      query.block = number == VoxelStorage::kNoBlock ? nullptr : &storage.block(number);
    }
    if (query.block != nullptr)
      for (const std::uint8_t slot : query.address.slots)
        __builtin_prefetch(&query.block->voxels[slot]);
  }
}

void findVoxels(const VoxelShards& shards, std::size_t count, Batch& batch)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    Query& query = batch[i];
    for (std::size_t s = 0; s < kVoxelScales; ++s)
    {
      query.voxels[s] = query.block == nullptr ? VoxelStorage::kNoVoxel
                                               : query.block->voxels[query.address.slots[s]];
      __builtin_prefetch(&shards[query.shard].voxel(query.voxels[s]));
    }
  }
}

PlaneMatch bestPlane(const VoxelShards& shards, const Query& query, float x, float y, float z)
{
  PlaneMatch best;
  for (const std::uint32_t number : query.voxels)
  {
    // Voxel number kNoVoxel exists and has no plane.
    const VoxelPlane& plane = shards[query.shard].voxel(number).plane();
    if (!plane.valid()) continue;
    // What the surface departs from the plane stays where it is: like the plane's offset it is one
    // error for all points that meet it, in this scan and in the next.
    const float variance = plane.offsetVariance(x, y, z) + plane.roughness;
    if (best.valid() && variance >= best.variance) continue;
    best = {
        plane.nx,
        plane.ny,
        plane.nz,
        plane.offset(),
        variance,
        variance,
        VoxelShards::numberOf(number, query.shard),
        plane.created_insertion,
        plane.normalVariance()};
  }
  return best;
}
}  // namespace

void matchPlanes(
    const VoxelShards& shards, const VoxelGrid& grid, const WorldPoints& points, std::size_t first,
    std::size_t last, std::vector<PlaneMatch>& matches)
{
  Batch batch;
  for (std::size_t begin = first; begin < last; begin += kBatch)
  {
    const std::size_t count = std::min(kBatch, last - begin);
    findBlocks(shards, grid, points, begin, count, batch);
    findVoxels(shards, count, batch);
    for (std::size_t i = 0; i < count; ++i)
      matches[begin + i] = bestPlane(
          shards, batch[i], points.x[begin + i], points.y[begin + i], points.z[begin + i]);
  }
}

}  // namespace fastlio
