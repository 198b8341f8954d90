// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_blocks.h"
#include <fastlio/map/voxel_plane_map.h>

namespace fastlio
{
using namespace voxel_blocks;

std::uint32_t VoxelPlaneMap::findOrAddBlock(std::uint64_t key)
{
  const auto it = index_.find(key);
  if (it != index_.end()) return it->second;
  auto block = static_cast<std::uint32_t>(blocks_.size());
  if (free_blocks_.empty())
    blocks_.emplace_back();
  else
  {
    block = free_blocks_.back();
    free_blocks_.pop_back();
    blocks_[block] = Block{};
  }
  blocks_[block].key = key;
  blocks_[block].used = true;
  index_.emplace(key, block);
  return block;
}

std::uint32_t VoxelPlaneMap::addVoxel()
{
  if (!free_voxels_.empty())
  {
    const std::uint32_t index = free_voxels_.back();
    free_voxels_.pop_back();
    voxelAt(index) = PlaneVoxel{};
    return index;
  }
  if (pool_size_ / kPoolChunk >= pool_.size())
    pool_.push_back(std::make_unique<std::array<PlaneVoxel, kPoolChunk>>());
  return pool_size_++;
}

bool VoxelPlaneMap::hasVoxels(std::uint32_t block, const Address& address) const
{
  const auto& voxels = blocks_[block].voxels;
  return voxels[address.slots[0]] != kNone && voxels[address.slots[1]] != kNone &&
         voxels[address.slots[2]] != kNone;
}

/** Finds block and voxels of the points [first, last), as far as they exist. */
void VoxelPlaneMap::locate(const WorldPoints& points, std::size_t first, std::size_t last)
{
  std::uint64_t last_key = 0;
  std::uint32_t block = kNoBlock;
  for (std::size_t i = first; i < last; ++i)
  {
    const Address address = addressOf(points.x[i], points.y[i], points.z[i]);
    if (i == first || address.block_key != last_key)
    {
      const auto it = index_.find(address.block_key);
      block = it == index_.end() ? kNoBlock : it->second;
      last_key = address.block_key;
    }
    arrivals_[i] = {address, block, block != kNoBlock && hasVoxels(block, address)};
  }
}

/** Adds the block and the voxels that a point lacks. */
void VoxelPlaneMap::makeRoom(Arrival& arrival)
{
  if (arrival.block == kNoBlock) arrival.block = findOrAddBlock(arrival.address.block_key);
  for (const std::uint8_t slot : arrival.address.slots)
  {
    std::uint32_t& index = blocks_[arrival.block].voxels[slot];
    if (index != kNone) continue;
    index = addVoxel();
    finest_count_ += slot < kMiddleSlot ? 1 : 0;
  }
}

void VoxelPlaneMap::addPoint(
    const Arrival& arrival, const Eigen::Vector3f& point, const Eigen::Vector3f& beam,
    std::vector<Refit>& refits)
{
  for (const std::uint8_t slot : arrival.address.slots)
  {
    const std::uint32_t index = blocks_[arrival.block].voxels[slot];
    PlaneVoxel& voxel = voxelAt(index);
    voxel.add(point - centerOf(arrival.address.block_key, slot), beam);
    if (voxel.claimRefit()) refits.push_back({index, arrival.address.block_key, slot});
  }
}

void VoxelPlaneMap::insertShard(
    Shard& shard, const WorldPoints& points, const Eigen::Vector3f& origin)
{
  for (const std::uint32_t i : shard.points)
  {
    const Eigen::Vector3f point(points.x[i], points.y[i], points.z[i]);
    addPoint(arrivals_[i], point, (point - origin).normalized(), shard.refits);
  }
  for (const Refit& r : shard.refits)
    voxelAt(r.voxel).fit(centerOf(r.block_key, r.slot), options_.rules, scan_);
  shard.points.clear();
  shard.refits.clear();
}

// Blocks and voxels are numbered in the order of the points, by one thread; a block's points are
// added in their order, by one thread: the map does not depend on how many there are.
void VoxelPlaneMap::insert(const WorldPoints& points, const Vec3& sensor_origin)
{
  ++scan_;
  const Eigen::Vector3f origin = sensor_origin.cast<float>();
  arrivals_.resize(points.size());
  workers_->forEachChunk(
      points.size(),
      [&](std::size_t, std::size_t first, std::size_t last) { locate(points, first, last); });
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    Arrival& arrival = arrivals_[i];
    if (!arrival.placed) makeRoom(arrival);
    shards_[arrival.block % kShards].points.push_back(static_cast<std::uint32_t>(i));
  }
  workers_->forEach(kShards, [&](std::size_t i) { insertShard(shards_[i], points, origin); });
}

}  // namespace fastlio
