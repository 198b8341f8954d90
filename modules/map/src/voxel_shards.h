// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_shards.h The voxels of a map in parts that share nothing. */
#pragma once

#include "voxel_storage.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Blocks are dealt out to a fixed number of storages by their keys. A storage is changed by one
 * thread at a time, several storages by several threads: the map does not depend on how many there
 * are, and no thread waits for, or reads, what another one writes. */
class VoxelShards
{
 public:
  static constexpr std::size_t kCount = 16;

  VoxelShards() : arena_(std::make_unique<PageArena>())
  {
    shards_.reserve(kCount);
    for (std::size_t shard = 0; shard < kCount; ++shard)
      shards_.emplace_back(*arena_);
  }
  ~VoxelShards() = default;
  VoxelShards(const VoxelShards& other) : arena_(std::make_unique<PageArena>())
  {
    shards_.reserve(kCount);
    for (const VoxelStorage& storage : other.shards_)
      shards_.emplace_back(storage, *arena_);
  }
  VoxelShards(VoxelShards&&) noexcept = default;
  VoxelShards& operator=(VoxelShards other) noexcept
  {
    arena_.swap(other.arena_);
    shards_.swap(other.shards_);
    return *this;
  }

  [[nodiscard]] static std::uint8_t shardOf(std::uint64_t block_key)
  {
    // Both sides of a place are in the same one.
    return static_cast<std::uint8_t>(((block_key & ~kOtherSide) * 0xBF58476D1CE4E5B9ULL) >> 60U);
  }

  /** A number of a voxel that is unique in the whole map. */
  [[nodiscard]] static std::uint32_t numberOf(std::uint32_t voxel, std::size_t shard)
  {
    return voxel * static_cast<std::uint32_t>(kCount) + static_cast<std::uint32_t>(shard);
  }

  [[nodiscard]] VoxelStorage& operator[](std::size_t shard) { return shards_[shard]; }
  [[nodiscard]] const VoxelStorage& operator[](std::size_t shard) const { return shards_[shard]; }
  [[nodiscard]] VoxelStorage& ofBlock(std::uint64_t key) { return shards_[shardOf(key)]; }

  [[nodiscard]] std::size_t blockCount() const { return sum(&VoxelStorage::blockCount); }
  [[nodiscard]] std::size_t finestCount() const { return sum(&VoxelStorage::finestCount); }

  /** Calls visit(storage, shard, block) for each block in use. */
  template <typename Visit>
  void forEachBlock(const Visit& visit) const
  {
    for (std::size_t shard = 0; shard < kCount; ++shard)
      for (std::uint32_t i = 0; i < shards_[shard].blocksEnd(); ++i)
        if (shards_[shard].block(i).used) visit(shards_[shard], shard, shards_[shard].block(i));
  }

 private:
  [[nodiscard]] std::size_t sum(std::size_t (VoxelStorage::*count)() const) const
  {
    std::size_t total = 0;
    for (const VoxelStorage& storage : shards_)
      total += (storage.*count)();
    return total;
  }

  std::unique_ptr<PageArena> arena_;  // before what has its memory from it
  std::vector<VoxelStorage> shards_;
};

}  // namespace fastlio
