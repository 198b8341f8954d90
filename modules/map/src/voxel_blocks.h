// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_blocks.h Blocks of voxels of three sizes, and where a point lies in them. */
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** Slots of a block: 64 finest voxels, then 8 middle ones, then the coarse one. */
constexpr std::uint8_t kMiddleSlot = 64, kCoarseSlot = 72;
constexpr std::size_t kVoxelsPerBlock = 73;
constexpr std::size_t kVoxelScales = 3;

/** A surface that is seen from both sides is two surfaces, as far apart as the wall is thick. In a
 * voxel, the points of the one that came later are in a block of their own, at the same place. This
 * bit of its key says so. */
constexpr std::uint64_t kOtherSide = std::uint64_t{1} << 63U;

/** Where a point is: its block and its voxel of each scale in it. */
struct VoxelAddress
{
  std::uint64_t block_key = 0;
  std::array<std::uint8_t, kVoxelScales> slots{};
};

/** Cuts space into blocks of 4 x 4 x 4 finest voxels; a key has 21 bits per axis. */
class VoxelGrid
{
 public:
  explicit VoxelGrid(double voxel_size)
      : size_(static_cast<float>(voxel_size)), inverse_size_(static_cast<float>(1.0 / voxel_size))
  {
    for (std::uint8_t slot = 0; slot < kVoxelsPerBlock; ++slot)
      offsets_[slot] = offsetOf(slot);
  }

  /** Whether a point is finite and inside of the numbered space. */
  [[nodiscard]] bool contains(float x, float y, float z) const
  {
    return std::abs(x) < limit() && std::abs(y) < limit() && std::abs(z) < limit();
  }

  /** Whether it contains() two points in one finest voxel, and so in one voxel of each scale.
   * Without branches, so that a compiler can look at several pairs at once. */
  [[nodiscard]] bool isInSameVoxel(float x1, float y1, float z1, float x2, float y2, float z2) const
  {
    const bool x = isInSameCell(x1, x2), y = isInSameCell(y1, y2), z = isInSameCell(z1, z2);
    return (static_cast<int>(x) & static_cast<int>(y) & static_cast<int>(z)) != 0;
  }

  /** Of a point that it contains(). Filled in place: a copy would have to wait until the slots,
   * which are written one by one, have left the processor. */
  void locate(float x, float y, float z, VoxelAddress& address) const
  {
    const Cell c = cellOf(x, y, z);
    address.block_key = keyOf(c.x >> 2, c.y >> 2, c.z >> 2);
    address.slots[0] = rowMajor(c.x & 3, c.y & 3, c.z & 3, 4);
    address.slots[1] = static_cast<std::uint8_t>(
        kMiddleSlot + rowMajor((c.x >> 1) & 1, (c.y >> 1) & 1, (c.z >> 1) & 1, 2));
    address.slots[2] = kCoarseSlot;
  }

  /** Key of the block of a point that it contains(). */
  [[nodiscard]] std::uint64_t blockKeyOf(float x, float y, float z) const
  {
    const Cell c = cellOf(x, y, z);
    return keyOf(c.x >> 2, c.y >> 2, c.z >> 2);
  }

  /** Key of the block with these block coordinates. */
  [[nodiscard]] static std::uint64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z)
  {
    const auto axis = [](std::int64_t i)
    { return static_cast<std::uint64_t>(i + kAxisBias) & kAxisMask; };
    return (axis(x) << (2 * kAxisBits)) | (axis(y) << kAxisBits) | axis(z);
  }

  /** Edge of a block [m]. */
  [[nodiscard]] float blockSize() const { return 4 * size_; }

  /** Lowest corner of a block [m]. */
  [[nodiscard]] Eigen::Vector3f cornerOf(std::uint64_t block_key) const
  {
    const auto axis = [&](int shift)
    {
      const auto bits = static_cast<std::int64_t>((block_key >> shift) & kAxisMask);
      return static_cast<float>(bits - kAxisBias);
    };
    return Eigen::Vector3f(axis(2 * kAxisBits), axis(kAxisBits), axis(0)) * blockSize();
  }

  /** Centre of a voxel [m]. */
  [[nodiscard]] Eigen::Vector3f centerOf(std::uint64_t block_key, std::uint8_t slot) const
  {
    return cornerOf(block_key) + offsets_[slot];
  }

  /** Centre of a voxel minus the lowest corner of its block [m]. */
  [[nodiscard]] const Eigen::Vector3f& centerInBlock(std::uint8_t slot) const
  {
    return offsets_[slot];
  }

 private:
  static constexpr int kAxisBits = 21;
  static constexpr std::int64_t kAxisBias = std::int64_t{1} << (kAxisBits - 1);
  static constexpr std::uint64_t kAxisMask = (std::uint64_t{1} << kAxisBits) - 1U;

  /** Coordinates of a finest voxel. */
  struct Cell
  {
    std::int32_t x, y, z;
  };

  [[nodiscard]] float limit() const { return static_cast<float>(4 * (kAxisBias - 1)) * size_; }

  /** Of one axis. */
  [[nodiscard]] bool isInSameCell(float a, float b) const
  {
    const bool a_inside = std::abs(a) < limit(), b_inside = std::abs(b) < limit();
    const std::int32_t cell_a = roundDown((a_inside ? a : 0.0F) * inverse_size_);
    const std::int32_t cell_b = roundDown((b_inside ? b : 0.0F) * inverse_size_);
    const bool same = cell_a == cell_b;
    return (static_cast<int>(a_inside) & static_cast<int>(b_inside) & static_cast<int>(same)) != 0;
  }

  /** Rounding down and arithmetic shifts keep negative coordinates in voxels of their own. */
  [[nodiscard]] Cell cellOf(float x, float y, float z) const
  {
    return {
        roundDown(x * inverse_size_), roundDown(y * inverse_size_), roundDown(z * inverse_size_)};
  }

  /** std::floor() of a number that fits: a call of a library, in a build for the baseline. */
  [[nodiscard]] static std::int32_t roundDown(float number)
  {
    const auto towards_zero = static_cast<std::int32_t>(number);
    return towards_zero - (number < static_cast<float>(towards_zero) ? 1 : 0);
  }

  /** Position of a voxel among n x n x n. */
  [[nodiscard]] static std::uint8_t rowMajor(
      std::int32_t x, std::int32_t y, std::int32_t z, std::int32_t n)
  {
    return static_cast<std::uint8_t>((x * n + y) * n + z);
  }

  [[nodiscard]] Eigen::Vector3f offsetOf(std::uint8_t slot) const
  {
    if (slot >= kCoarseSlot) return Eigen::Vector3f::Constant(2 * size_);
    const int n = slot >= kMiddleSlot ? 2 : 4;
    const int i = slot >= kMiddleSlot ? slot - kMiddleSlot : slot;
    const Eigen::Vector3i cell(i / (n * n), (i / n) % n, i % n);
    const float edge = blockSize() / static_cast<float>(n);
    return (cell.cast<float>() + Eigen::Vector3f::Constant(0.5F)) * edge;
  }

  float size_, inverse_size_;
  std::array<Eigen::Vector3f, kVoxelsPerBlock> offsets_;
};

}  // namespace fastlio
