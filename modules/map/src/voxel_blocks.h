// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_blocks.h Keys of the blocks of a VoxelPlaneMap, and the numbering of voxels in them.
 */
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace fastlio::voxel_blocks
{
constexpr int kAxisBits = 21;
constexpr std::int64_t kAxisBias = std::int64_t{1} << (kAxisBits - 1);
constexpr std::uint64_t kAxisMask = (std::uint64_t{1} << kAxisBits) - 1U;
// Slots of a block: 64 finest, then 8 middle, then 1 coarse voxel.
constexpr std::uint8_t kMiddleSlot = 64, kCoarseSlot = 72;

[[nodiscard]] inline std::uint64_t packKey(std::int64_t x, std::int64_t y, std::int64_t z)
{
  const auto axis = [](std::int64_t i)
  { return static_cast<std::uint64_t>(i + kAxisBias) & kAxisMask; };
  return (axis(x) << (2 * kAxisBits)) | (axis(y) << kAxisBits) | axis(z);
}

[[nodiscard]] inline Eigen::Vector3f unpackKey(std::uint64_t key)
{
  const auto axis = [&](int shift)
  { return static_cast<float>(static_cast<std::int64_t>((key >> shift) & kAxisMask) - kAxisBias); };
  return {axis(2 * kAxisBits), axis(kAxisBits), axis(0)};
}

/** Row-major position of a voxel among n x n x n. */
[[nodiscard]] inline std::uint8_t rowMajor(
    std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t n)
{
  return static_cast<std::uint8_t>((x * n + y) * n + z);
}
}  // namespace fastlio::voxel_blocks
