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
  return grid.contains(x, y, z) ? VoxelShards::shardOf(grid.blockKeyOf(x, y, z)) : kNoShard;
}
}  // namespace

/** One pass over the points, not one for each shard. */
void VoxelInserter::sortByShard(
    const WorldPoints& points, const VoxelGrid& grid, const Workers& workers)
{
  shard_of_.resize(points.size());
  workers.forEachChunk(
      points.size(),
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
          shard_of_[i] = shardOf(grid, points.x[i], points.y[i], points.z[i]);
      });
  std::array<std::size_t, VoxelShards::kCount + 1> next{};  // the last counts what lies nowhere
  for (const std::uint8_t shard : shard_of_)
    ++next[shard];
  std::size_t first = 0;
  for (std::size_t shard = 0; shard < VoxelShards::kCount; ++shard)
  {
    ranges_[shard] = {first, first + next[shard]};
    next[shard] = first;
    first = ranges_[shard].last;
  }
  next[kNoShard] = first;
  by_shard_.resize(points.size());
  for (std::size_t i = 0; i < shard_of_.size(); ++i)
    by_shard_[next[shard_of_[i]]++] = static_cast<std::uint32_t>(i);
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
    const VoxelBlock& block = storage.block(arrival.block);
    for (std::size_t s = 0; s < kVoxelScales; ++s)
    {
      const std::uint8_t slot = arrival.address.slots[s];
      std::uint32_t voxel = block.voxels[slot];
      if (voxel == VoxelStorage::kNoVoxel) voxel = storage.addVoxel(arrival.block, slot);
      arrival.voxels[s] = voxel;
    }
  }
}

/** The voxel at the same place for those who see its plane from behind; added where it lacks. */
std::uint32_t VoxelInserter::otherSideOf(
    const Arrival& arrival, std::size_t scale, VoxelStorage& storage)
{
  const std::uint32_t block = storage.findOrAdd(arrival.address.block_key | kOtherSide);
  const std::uint8_t slot = arrival.address.slots[scale];
  const std::uint32_t voxel = storage.block(block).voxels[slot];
  return voxel == VoxelStorage::kNoVoxel ? storage.addVoxel(block, slot) : voxel;
}

void VoxelInserter::addPoint(
    const Arrival& arrival, const WorldPoints& points, const InsertionContext& context,
    VoxelStorage& storage, std::vector<Refit>& refits)
{
  const std::uint32_t i = arrival.point;
  const std::uint64_t key = arrival.address.block_key;
  const Eigen::Vector3f point(points.x[i], points.y[i], points.z[i]);
  const Eigen::Vector3f beam = (point - context.origin).normalized();
  const Eigen::Vector3f corner = context.grid.cornerOf(key);
  for (std::size_t s = 0; s < kVoxelScales; ++s)
  {
    const std::uint8_t slot = arrival.address.slots[s];
    std::uint32_t number = arrival.voxels[s];
    PlaneVoxel* voxel = &storage.voxel(number);
    if (voxel->plane().isSeenFromBehind(beam))
    {
      number = otherSideOf(arrival, s, storage);
      voxel = &storage.voxel(number);
      // Neither side: a third surface would spoil both.
      if (voxel->plane().isSeenFromBehind(beam)) continue;
    }
    voxel->add(point - (corner + context.grid.centerInBlock(slot)), beam, context.from_new_view);
    if (voxel->claimRefit()) refits.push_back({number, slot, key});
  }
}

void VoxelInserter::insertShard(
    std::uint8_t shard, const WorldPoints& points, const InsertionContext& context,
    VoxelStorage& storage)
{
  std::vector<Arrival>& arrivals = benches_[shard].arrivals;
  std::vector<Refit>& refits = benches_[shard].refits;
  arrivals.clear();
  refits.clear();
  for (std::size_t k = ranges_[shard].first; k < ranges_[shard].last; ++k)
  {
    const std::uint32_t i = by_shard_[k];
    Arrival& arrival = arrivals.emplace_back();
    arrival.point = i;
    context.grid.locate(points.x[i], points.y[i], points.z[i], arrival.address);
  }
  findVoxels(arrivals, storage);
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
  sortByShard(points, context.grid, workers);
  workers.forEach(
      VoxelShards::kCount, [&](std::size_t shard)
      { insertShard(static_cast<std::uint8_t>(shard), points, context, shards[shard]); });
}

}  // namespace fastlio
