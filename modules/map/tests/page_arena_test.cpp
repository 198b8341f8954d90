// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "../src/page_arena.h"

#include "../src/paged_pool.h"
#include "../src/voxel_shards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

using namespace fastlio;

namespace
{
struct Piece
{
  unsigned char* memory;
  std::size_t bytes;
};

bool overlap(std::vector<Piece> pieces)
{
  std::sort(
      pieces.begin(), pieces.end(),
      [](const Piece& a, const Piece& b) { return a.memory < b.memory; });
  for (std::size_t i = 1; i < pieces.size(); ++i)
    if (pieces[i - 1].memory + pieces[i - 1].bytes > pieces[i].memory) return true;
  return false;
}

std::vector<Piece> allocateMany(PageArena& arena, std::size_t count)
{
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t bytes = 1 + (i * 7919) % 40000;
    pieces.push_back({static_cast<unsigned char*>(arena.allocate(bytes)), bytes});
    std::memset(pieces.back().memory, static_cast<int>(i), bytes);
  }
  return pieces;
}

TEST(PageArena, PiecesAreAlignedAndApart)
{
  PageArena arena;
  // Beyond the slabs that double, into those of large pages.
  const std::vector<Piece> pieces = allocateMany(arena, 400);
  for (const Piece& piece : pieces)
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(piece.memory) % 64, 0U);
  EXPECT_FALSE(overlap(pieces));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    EXPECT_EQ(pieces[i].memory[pieces[i].bytes - 1], static_cast<unsigned char>(i));
}

TEST(PageArena, MorePerPieceThanASlabHolds)
{
  PageArena arena;
  std::vector<Piece> pieces;
  for (const std::size_t bytes : {std::size_t{5} << 20U, std::size_t{100}, std::size_t{3} << 20U})
  {
    pieces.push_back({static_cast<unsigned char*>(arena.allocate(bytes)), bytes});
    std::memset(pieces.back().memory, 1, bytes);
  }
  EXPECT_FALSE(overlap(pieces));
}

TEST(PageArena, SeveralThreadsMayAsk)
{
  PageArena arena;
  std::vector<std::vector<Piece>> of_thread(4);
  std::vector<std::thread> threads;
  threads.reserve(of_thread.size());
  for (auto& pieces : of_thread)
    threads.emplace_back([&] { pieces = allocateMany(arena, 100); });
  for (std::thread& thread : threads)
    thread.join();
  std::vector<Piece> all;
  for (const auto& pieces : of_thread)
    all.insert(all.end(), pieces.begin(), pieces.end());
  EXPECT_FALSE(overlap(all));
}

TEST(VoxelShards, ACopyHasItsOwnMemory)
{
  VoxelShards copy;
  {
    VoxelShards original;
    for (std::uint64_t key = 0; key < 500; ++key)
    {
      VoxelStorage& storage = original.ofBlock(key);
      const std::uint32_t voxel = storage.addVoxel(storage.findOrAdd(key), kCoarseSlot);
      storage.voxel(voxel).add({0.001F * static_cast<float>(key), 0, 0}, {0, 0, 1});
    }
    copy = original;
    original.ofBlock(0).drop(original.ofBlock(0).find(0));
    EXPECT_EQ(original.blockCount(), 499U);
  }
  ASSERT_EQ(copy.blockCount(), 500U);
  for (std::uint64_t key = 0; key < 500; ++key)
  {
    VoxelStorage& storage = copy.ofBlock(key);
    const std::uint32_t voxel = storage.block(storage.find(key)).voxels[kCoarseSlot];
    EXPECT_EQ(storage.voxel(voxel).meanOffset().x(), 0.001F * static_cast<float>(key));
  }
}

}  // namespace
