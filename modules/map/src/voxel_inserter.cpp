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
}  // namespace

/** Finds block and voxels of the points [first, last), as far as they exist. */
void VoxelInserter::locate(
    const WorldPoints& points, const VoxelGrid& grid, const VoxelStorage& storage,
    std::size_t first, std::size_t last)
{
  for (std::size_t i = first; i < last; ++i)
  {
    Arrival& arrival = arrivals_[i];
    arrival.address = grid.addressOf(points.x[i], points.y[i], points.z[i]);
    // Neighbours in the scan mostly share the block.
    const bool same = i > first && arrivals_[i - 1].address.block_key == arrival.address.block_key;
    arrival.block = same ? arrivals_[i - 1].block : storage.find(arrival.address.block_key);
    if (arrival.block != VoxelStorage::kNoBlock)
      __builtin_prefetch(&storage.block(arrival.block).voxels[arrival.address.slots[0]]);
  }
  for (std::size_t i = first; i < last; ++i)
  {
    Arrival& arrival = arrivals_[i];
    arrival.voxels.fill(VoxelStorage::kNoVoxel);
    if (arrival.block == VoxelStorage::kNoBlock) continue;
    for (std::size_t s = 0; s < kVoxelScales; ++s)
      arrival.voxels[s] = storage.block(arrival.block).voxels[arrival.address.slots[s]];
  }
}

/** Adds the block and the voxels that a point lacks. */
void VoxelInserter::makeRoom(Arrival& arrival, VoxelStorage& storage)
{
  if (arrival.block == VoxelStorage::kNoBlock)
    arrival.block = storage.findOrAdd(arrival.address.block_key);
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    const std::uint8_t slot = arrival.address.slots[s];
    std::uint32_t& voxel = arrival.voxels[s];
    voxel = storage.block(arrival.block).voxels[slot];
    if (voxel == VoxelStorage::kNoVoxel) voxel = storage.addVoxel(arrival.block, slot);
  }
}

void VoxelInserter::distribute(VoxelStorage& storage)
{
  for (std::size_t i = 0; i < arrivals_.size(); ++i)
  {
    Arrival& arrival = arrivals_[i];
    const auto& voxels = arrival.voxels;
    const bool complete =
        std::find(voxels.begin(), voxels.end(), VoxelStorage::kNoVoxel) == voxels.end();
    if (!complete) makeRoom(arrival, storage);
    shards_[arrival.block % kShards].points.push_back(static_cast<std::uint32_t>(i));
  }
}

void VoxelInserter::addPoint(
    std::uint32_t i, const WorldPoints& points, const Eigen::Vector3f& origin,
    const VoxelGrid& grid, VoxelStorage& storage, std::vector<Refit>& refits) const
{
  const Arrival& arrival = arrivals_[i];
  const Eigen::Vector3f point(points.x[i], points.y[i], points.z[i]);
  const Eigen::Vector3f beam = (point - origin).normalized();
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    const std::uint8_t slot = arrival.address.slots[s];
    PlaneVoxel& voxel = storage.voxel(arrival.voxels[s]);
    voxel.add(point - grid.centerOf(arrival.address.block_key, slot), beam);
    if (voxel.claimRefit()) refits.push_back({arrival.voxels[s], slot, arrival.address.block_key});
  }
}

void VoxelInserter::insert(
    const WorldPoints& points, const Eigen::Vector3f& origin, const VoxelGrid& grid,
    const PlaneRules& rules, std::uint32_t scan, const Workers& workers, VoxelStorage& storage)
{
  arrivals_.resize(points.size());
  workers.forEachChunk(
      points.size(), [&](std::size_t, std::size_t first, std::size_t last)
      { locate(points, grid, storage, first, last); });
  distribute(storage);
  const auto insert_shard = [&](std::size_t number)
  {
    Shard& shard = shards_[number];
    for (std::size_t k = 0; k < shard.points.size(); ++k)
    {
      const std::size_t ahead = std::min(k + kLookAhead, shard.points.size() - 1);
      for (const std::uint32_t voxel : arrivals_[shard.points[ahead]].voxels)
        fetchForWriting(&storage.voxel(voxel));
      addPoint(shard.points[k], points, origin, grid, storage, shard.refits);
    }
    for (const Refit& r : shard.refits)
      storage.voxel(r.voxel).fit(grid.centerOf(r.block_key, r.slot), rules, scan);
    shard.points.clear();
    shard.refits.clear();
  };
  workers.forEach(kShards, insert_shard);
}

}  // namespace fastlio
