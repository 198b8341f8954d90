// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_storage.h Blocks of voxels in memory: found by key, numbered, reused. */
#pragma once

#include "paged_pool.h"
#include "voxel_blocks.h"
#include <fastlio/map/plane_voxel.h>

#include <tsl/robin_map.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** The numbers of a block's voxels; VoxelStorage::kNoVoxel where there is none. */
struct alignas(64) VoxelBlock
{
  std::array<std::uint32_t, kVoxelsPerBlock> voxels{};
  bool used = false;
  std::uint64_t key = 0;
};

/** A voxel on two cache lines: its plane on the first, which searching reads, its sums on the
 * other.
 */
struct alignas(64) StoredVoxel : PlaneVoxel
{
};

/** Owns blocks and voxels. Growth moves nothing but a part of the index, so that no insertion
 * stands out; what is dropped is used again. Const methods may run in several threads at once. */
class VoxelStorage
{
 public:
  static constexpr std::uint32_t kNoVoxel = 0;
  static constexpr std::uint32_t kNoBlock = ~0U;

  explicit VoxelStorage(PageArena& arena);
  /** A copy of \a other in other memory. */
  VoxelStorage(const VoxelStorage& other, PageArena& arena);

  /** Number of the block with a key, or kNoBlock. */
  [[nodiscard]] std::uint32_t find(std::uint64_t key) const
  {
    const auto& index = index_[indexOf(key)];
    const auto it = index.find(key);
    return it == index.end() ? kNoBlock : it->second;
  }
  std::uint32_t findOrAdd(std::uint64_t key);

  [[nodiscard]] const VoxelBlock& block(std::uint32_t number) const { return blocks_[number]; }
  /** Numbers of blocks are below this; not all are used. */
  [[nodiscard]] std::uint32_t blocksEnd() const { return blocks_.end(); }
  [[nodiscard]] std::size_t blockCount() const { return block_count_; }

  [[nodiscard]] StoredVoxel& voxel(std::uint32_t number) { return voxels_[number]; }
  [[nodiscard]] const StoredVoxel& voxel(std::uint32_t number) const { return voxels_[number]; }
  /** Gives the block a voxel in a slot where it has none. */
  std::uint32_t addVoxel(std::uint32_t block, std::uint8_t slot);
  /** Number of finest voxels. */
  [[nodiscard]] std::size_t finestCount() const { return finest_count_; }

  /** Forgets a block and its voxels. */
  void drop(std::uint32_t number);

 private:
  /** Spreads the bits of a block key. */
  struct KeyHash
  {
    std::size_t operator()(std::uint64_t key) const
    {
      key *= 0x9E3779B97F4A7C15ULL;
      return static_cast<std::size_t>(key ^ (key >> 32U));
    }
  };

  // A hash that doubles moves all it holds: many small ones do so at different times.
  static constexpr std::size_t kIndexes = 8;
  [[nodiscard]] static std::size_t indexOf(std::uint64_t key)
  {
    return static_cast<std::size_t>((key * 0xD6E8FEB86659FD93ULL) >> 61U);
  }

  std::array<tsl::robin_map<std::uint64_t, std::uint32_t, KeyHash>, kIndexes> index_;
  PagedPool<VoxelBlock, 6> blocks_;
  PagedPool<StoredVoxel, 8> voxels_;
  std::size_t block_count_ = 0;
  std::size_t finest_count_ = 0;
};

}  // namespace fastlio
