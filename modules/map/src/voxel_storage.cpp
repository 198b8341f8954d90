// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "voxel_storage.h"

#include <algorithm>

namespace fastlio
{
VoxelStorage::VoxelStorage(PageArena& arena) : blocks_(arena), voxels_(arena)
{
  (void)voxels_.acquire();  // number 0 means that there is none
}

VoxelStorage::VoxelStorage(const VoxelStorage& other, PageArena& arena)
    : index_(other.index_),
      blocks_(other.blocks_, arena),
      voxels_(other.voxels_, arena),
      block_count_(other.block_count_),
      finest_count_(other.finest_count_)
{
}

std::uint32_t VoxelStorage::findOrAdd(std::uint64_t key)
{
  const std::uint32_t found = find(key);
  if (found != kNoBlock) return found;
  const std::uint32_t number = blocks_.acquire();
  blocks_[number].key = key;
  blocks_[number].used = true;
  index_[indexOf(key)].emplace(key, number);
  ++block_count_;
  return number;
}

std::uint32_t VoxelStorage::addVoxel(std::uint32_t block, std::uint8_t slot)
{
  const std::uint32_t number = voxels_.acquire();
  blocks_[block].voxels[slot] = number;
  finest_count_ += slot < kMiddleSlot ? 1 : 0;
  return number;
}

void VoxelStorage::drop(std::uint32_t number)
{
  VoxelBlock& block = blocks_[number];
  index_[indexOf(block.key)].erase(block.key);
  for (std::size_t slot = 0; slot < kVoxelsPerBlock; ++slot)
  {
    if (block.voxels[slot] == kNoVoxel) continue;
    voxels_.release(block.voxels[slot]);
    finest_count_ -= slot < kMiddleSlot ? 1 : 0;
  }
  block.used = false;
  blocks_.release(number);
  --block_count_;
}

}  // namespace fastlio
