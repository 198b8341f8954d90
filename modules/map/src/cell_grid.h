// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cell_grid.h Cubic cells of space, grouped in blocks of 4x4x4, and distances to them. */
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace fastlio
{
/** A point of a query or of the map [m]. */
struct Point3
{
  float x = 0, y = 0, z = 0;
};

[[nodiscard]] inline bool isFinite(const Point3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/** The one formula for squared distances [m^2], so that every search compares the same numbers. */
[[nodiscard]] inline float squaredDistance(const Point3& a, const Point3& b)
{
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return dx * dx + dy * dy + dz * dz;
}

/** Integer coordinates of a cell or a block; negative ones lie below the origin. */
struct GridCoord
{
  std::int32_t x = 0, y = 0, z = 0;
};

[[nodiscard]] inline GridCoord operator+(const GridCoord& a, const GridCoord& b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/** Cells per block edge, as a power of two. */
constexpr std::int32_t kBlockBits = 2;
constexpr std::int32_t kBlockEdge = 1 << kBlockBits;
constexpr std::size_t kBlockCells = 64;

/** Block coordinates fit into 21 bits each; one block is kept free at either end so that neighbours
 * of any block have a key too. */
constexpr std::int32_t kBlockLimit = (1 << 20) - 2;
constexpr std::int32_t kCellLimit = kBlockLimit * kBlockEdge;

/** Block of a cell; the shift is arithmetic, hence right below zero. */
[[nodiscard]] inline GridCoord blockOf(const GridCoord& cell)
{
  return {cell.x >> kBlockBits, cell.y >> kBlockBits, cell.z >> kBlockBits};
}

/** Number of a cell inside of its block. */
[[nodiscard]] inline std::uint32_t cellInBlock(const GridCoord& cell)
{
  constexpr std::int32_t kMask = kBlockEdge - 1;
  return static_cast<std::uint32_t>(
      (cell.x & kMask) | ((cell.y & kMask) << kBlockBits) | ((cell.z & kMask) << (2 * kBlockBits)));
}

/** The cell of a block, inverse of blockOf() and cellInBlock(). */
[[nodiscard]] inline GridCoord cellOfBlock(const GridCoord& block, std::uint32_t cell_in_block)
{
  constexpr std::uint32_t kMask = kBlockEdge - 1;
  return {
      block.x * kBlockEdge + static_cast<std::int32_t>(cell_in_block & kMask),
      block.y * kBlockEdge + static_cast<std::int32_t>((cell_in_block >> kBlockBits) & kMask),
      block.z * kBlockEdge + static_cast<std::int32_t>(cell_in_block >> (2 * kBlockBits))};
}

/** The lowest cell of a block on every axis. */
[[nodiscard]] inline GridCoord firstCell(const GridCoord& block)
{
  return {block.x * kBlockEdge, block.y * kBlockEdge, block.z * kBlockEdge};
}

/** Blocks from low to high, both included. */
struct BlockRange
{
  GridCoord low, high;

  /** Number of blocks; real, as it may be huge. */
  [[nodiscard]] double count() const
  {
    return (high.x - low.x + 1.0) * (high.y - low.y + 1.0) * (high.z - low.z + 1.0);
  }

  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (std::int32_t z = low.z; z <= high.z; ++z)
    {
      for (std::int32_t y = low.y; y <= high.y; ++y)
      {
        for (std::int32_t x = low.x; x <= high.x; ++x)
          visit(GridCoord{x, y, z});
      }
    }
  }
};

/** Unique key of a block within kBlockLimit. */
[[nodiscard]] inline std::uint64_t blockKey(const GridCoord& block)
{
  constexpr std::uint64_t kMask = (1ULL << 21) - 1;
  const auto bits = [](std::int32_t v) { return static_cast<std::uint64_t>(v) & kMask; };
  return bits(block.x) | (bits(block.y) << 21) | (bits(block.z) << 42);
}

/** Spreads the bits of a key over a hash (Stafford's finaliser "Mix13" of 64-bit murmur). */
struct BlockKeyHash
{
  [[nodiscard]] std::size_t operator()(std::uint64_t k) const
  {
    k = (k ^ (k >> 30)) * 0xbf58476d1ce4e5b9ULL;
    k = (k ^ (k >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>(k ^ (k >> 31));
  }
};

/** A range of coordinates on one axis [m]. */
struct Interval
{
  double low = 0, high = 0;
};

/** Squared distance of a coordinate to an interval [m^2]. */
[[nodiscard]] inline double squaredGap(double coordinate, const Interval& interval)
{
  const double gap = std::max({interval.low - coordinate, coordinate - interval.high, 0.0});
  return gap * gap;
}

/** Cells of one edge length and the bounds they put on distances.
 *
 * A lower bound must never exceed the squared distance, computed in single precision, of a point in
 * the cell. Cells are therefore taken as larger than they are by kMargin edges, which covers the
 * rounding of the cell number, and bounds are shrunk by kShrink, which covers that of
 * squaredDistance() (below 3e-7). */
class CellGrid
{
 public:
  explicit CellGrid(double cell_size) : cell_size_(cell_size), inverse_(1.0 / cell_size) {}

  [[nodiscard]] double cellSize() const { return cell_size_; }

  /** Whether a point is finite and inside of the numbered space. */
  [[nodiscard]] bool contains(const Point3& p) const
  {
    const double limit = (kCellLimit - 1) * cell_size_;
    return std::abs(p.x) < limit && std::abs(p.y) < limit && std::abs(p.z) < limit;
  }

  /** Cell of a coordinate, clamped to the numbered space plus one block. */
  [[nodiscard]] std::int32_t cellOf(double coordinate) const
  {
    constexpr double kLimit = kCellLimit + kBlockEdge - 1;
    return static_cast<std::int32_t>(
        std::clamp(std::floor(coordinate * inverse_), -kLimit, kLimit));
  }

  [[nodiscard]] GridCoord cellOf(const Point3& p) const
  {
    return {cellOf(p.x), cellOf(p.y), cellOf(p.z)};
  }

  /** Blocks that hold every point within \a radius [m] of p. */
  [[nodiscard]] BlockRange blocksWithin(const Point3& p, double radius) const
  {
    const double r = radius * (1.0 + kMargin) + margin();
    return {
        blockOf({cellOf(p.x - r), cellOf(p.y - r), cellOf(p.z - r)}),
        blockOf({cellOf(p.x + r), cellOf(p.y + r), cellOf(p.z + r)})};
  }

  /** By how much the bounds take a cell as larger than it is [m]. */
  [[nodiscard]] double margin() const { return kMargin * cell_size_; }

  /** Space of \a cells cells from \a first on, widened by the margin. */
  [[nodiscard]] Interval interval(std::int32_t first, std::int32_t cells) const
  {
    return {(first - kMargin) * cell_size_, (first + cells + kMargin) * cell_size_};
  }

  /** Lower bound of the squared distance from p to the cube of \a cells^3 cells from \a first on.
   */
  [[nodiscard]] float lowerBound(const Point3& p, const GridCoord& first, std::int32_t cells) const
  {
    return shrink(
        squaredGap(p.x, interval(first.x, cells)) + squaredGap(p.y, interval(first.y, cells)) +
        squaredGap(p.z, interval(first.z, cells)));
  }

  [[nodiscard]] static float shrink(double squared)
  {
    return static_cast<float>(squared * kShrink);
  }

 private:
  static constexpr double kMargin = 1e-6;
  static constexpr double kShrink = 1.0 - 1e-6;

  double cell_size_;
  double inverse_;
};

}  // namespace fastlio
