// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_index.h A spatial index that grows and shrinks point by point. */
#pragma once

#include "cell_grid.h"
#include "neighbor_collectors.h"
#include "paged_pool.h"

#include <tsl/robin_map.h>

#include <vector>

namespace fastlio
{
/** Cells of space with the points in them: hash of blocks -> 4x4x4 cells -> chunks of eight points.
 *
 * One hash lookup serves 64 cells, a bit mask tells the empty ones, and coordinates lie together in
 * chunks that the compiler compares eight at a time. Points are known by the caller's numbering
 * (their index in the map's buffers), from 0 and dense. */
class PointIndex
{
 public:
  explicit PointIndex(double cell_size) : grid_(cell_size) {}

  [[nodiscard]] const CellGrid& grid() const { return grid_; }
  /** Number of points held. */
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool holds(std::uint32_t point) const
  {
    return point < place_of_.size() && place_of_[point] != kNowhere;
  }
  [[nodiscard]] std::size_t memoryBytes() const;

  /** Adds a point that grid().contains(). */
  void add(std::uint32_t point, const Point3& p);
  /** Forgets a point that it holds. */
  void remove(std::uint32_t point);
  /** Point \a from, which it holds, is called \a to from now on; \a to is not held. */
  void rename(std::uint32_t from, std::uint32_t to);
  /** Points farther than \a radius [m] from the center (x, y, z), in no particular order. */
  [[nodiscard]] std::vector<std::uint32_t> pointsOutside(
      double x, double y, double z, double radius) const;

  /** Offers the collector every point within its bound, the surroundings of the query first. */
  template <class Collector>
  void search(const Point3& query, Collector& collector) const;

 private:
  static constexpr std::uint32_t kChunkBits = 3;
  static constexpr std::uint32_t kChunkSize = 1U << kChunkBits;
  static constexpr std::uint32_t kNowhere = ~0U;

  /** Up to eight points of a cell; unused places are infinitely far away. Two cache lines. */
  struct alignas(64) Chunk
  {
    float x[kChunkSize], y[kChunkSize], z[kChunkSize];
    std::uint32_t point[kChunkSize];
    Chunk();
  };

  /** Chain of chunks, all full but the head. */
  struct Cell
  {
    std::uint32_t head = kNowhere;
    std::uint32_t count = 0;
  };

  struct Block
  {
    std::uint64_t occupied = 0;  //!< bit per cell
    GridCoord coord;
    Cell cells[kBlockCells];
  };

  /** Where a chunk belongs. */
  struct ChunkLink
  {
    std::uint32_t next = kNowhere;  //!< chunk after this one
    std::uint32_t block = 0;
    std::uint32_t cell = 0;
  };

  /** The blocks around a query's cell, looked up when first needed. */
  class Surroundings;

  [[nodiscard]] std::uint32_t blockNumber(const GridCoord& coord) const;
  [[nodiscard]] std::uint32_t obtainBlock(const GridCoord& coord);
  [[nodiscard]] std::uint32_t pushChunk(std::uint32_t block, std::uint32_t cell);
  void popPlace(std::uint32_t block, std::uint32_t cell);
  void appendOutside(
      const Block& block, const double (&center)[3], double radius,
      std::vector<std::uint32_t>& outside) const;

  template <class Collector>
  void searchCell(const Cell& cell, const Point3& query, Collector& collector) const;
  template <class Collector>
  double searchSurroundings(const Point3& query, const GridCoord& home, Collector& collector) const;
  template <class Collector>
  void searchBlock(
      const Block& block, const Point3& query, const GridCoord& home, Collector& collector) const;
  template <class Collector>
  void searchBeyond(const Point3& query, const GridCoord& home, Collector& collector) const;

  CellGrid grid_;
  tsl::robin_map<std::uint64_t, std::uint32_t, BlockKeyHash> blocks_by_key_;
  PagedPool<Block, 5> blocks_;
  PagedPool<Chunk, 8> chunks_;
  std::vector<ChunkLink> links_;         // per chunk
  std::vector<std::uint32_t> place_of_;  // per point: chunk and place in it
  std::size_t size_ = 0;
};

}  // namespace fastlio

#include "point_index_search.h"
