// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_inserter.h"

#include <algorithm>

namespace fastlio
{
namespace
{
// So many points ahead, voxels are fetched into the cache: most of them come from the memory.
constexpr std::size_t kLookAhead = 6;

void fetchForWriting(const void* voxel)
{
  __builtin_prefetch(voxel, 1);
  __builtin_prefetch(static_cast<const char*>(voxel) + 64, 1);
}

// Of points that lie in no voxel, such as those whose deskewing overflowed.
constexpr std::uint8_t kNoShard = VoxelShards::kCount;

std::uint8_t shardOf(const VoxelGrid& grid, float x, float y, float z)
{
  return grid.contains(x, y, z) ? VoxelShards::shardOf(grid.addressOf(x, y, z).block_key)
                                : kNoShard;
}
}  // namespace

void VoxelInserter::collect(
    std::uint8_t shard, const WorldPoints& points, const VoxelGrid& grid,
    std::vector<Arrival>& arrivals) const
{
  arrivals.clear();
  for (std::size_t i = 0; i < shard_of_.size(); ++i)
  {
    if (shard_of_[i] != shard) continue;
    arrivals.push_back(
        {static_cast<std::uint32_t>(i),
         grid.addressOf(points.x[i], points.y[i], points.z[i]),
         VoxelStorage::kNoBlock,
         {}});
  }
}

/** Finds block and voxels of each point; adds those that it lacks. */
void VoxelInserter::findVoxels(std::vector<Arrival>& arrivals, VoxelStorage& storage)
{
  for (std::size_t k = 0; k < arrivals.size(); ++k)
  {
    Arrival& arrival = arrivals[k];
    // Neighbours in the scan mostly share the block.
    const bool same = k > 0 && arrivals[k - 1].address.block_key == arrival.address.block_key;
    arrival.block = same ? arrivals[k - 1].block : storage.findOrAdd(arrival.address.block_key);
    __builtin_prefetch(&storage.block(arrival.block).voxels[arrival.address.slots[0]]);
  }
  for (Arrival& arrival : arrivals)
  {
    for (std::size_t s = 0; s < kVoxelScales; ++s)
    {
      const std::uint8_t slot = arrival.address.slots[s];
      std::uint32_t voxel = storage.block(arrival.block).voxels[slot];
      if (voxel == VoxelStorage::kNoVoxel) voxel = storage.addVoxel(arrival.block, slot);
      arrival.voxels[s] = voxel;
    }
  }
}

void VoxelInserter::addPoint(
    const Arrival& arrival, const WorldPoints& points, const InsertionContext& context,
    VoxelStorage& storage, std::vector<Refit>& refits)
{
  const std::uint32_t i = arrival.point;
  const std::uint64_t key = arrival.address.block_key;
  const Eigen::Vector3f point(points.x[i], points.y[i], points.z[i]);
  const Eigen::Vector3f beam = (point - context.origin).normalized();
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    const std::uint8_t slot = arrival.address.slots[s];
    PlaneVoxel& voxel = storage.voxel(arrival.voxels[s]);
    voxel.add(point - context.grid.centerOf(key, slot), beam);
    if (voxel.claimRefit()) refits.push_back({arrival.voxels[s], slot, key});
  }
}

void VoxelInserter::insertShard(
    std::uint8_t shard, const WorldPoints& points, const InsertionContext& context,
    VoxelStorage& storage)
{
  std::vector<Arrival>& arrivals = benches_[shard].arrivals;
  std::vector<Refit>& refits = benches_[shard].refits;
  collect(shard, points, context.grid, arrivals);
  findVoxels(arrivals, storage);
  refits.clear();
  for (std::size_t k = 0; k < arrivals.size(); ++k)
  {
    for (const std::uint32_t voxel : arrivals[std::min(k + kLookAhead, arrivals.size() - 1)].voxels)
      fetchForWriting(&storage.voxel(voxel));
    addPoint(arrivals[k], points, context, storage, refits);
  }
  for (const Refit& r : refits)
    storage.voxel(r.voxel).fit(
        context.grid.centerOf(r.block_key, r.slot), context.rules, context.scan);
}

void VoxelInserter::insert(
    const WorldPoints& points, const InsertionContext& context, const Workers& workers,
    VoxelShards& shards)
{
  shard_of_.resize(points.size());
  workers.forEachChunk(
      points.size(),
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
          shard_of_[i] = shardOf(context.grid, points.x[i], points.y[i], points.z[i]);
      });
  workers.forEach(
      VoxelShards::kCount, [&](std::size_t shard)
      { insertShard(static_cast<std::uint8_t>(shard), points, context, shards[shard]); });
}

}  // namespace fastlio
