// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_index_search.h The search of PointIndex: nearest cells first, then whole blocks.
 *
 * Every cell and block is skipped whose lower bound exceeds the collector's bound; as the bound
 * only shrinks, and equal distances are still offered, the outcome is exact in any order of visits.
 * The order only decides how soon the bound gets small. */
#pragma once

#include "point_index.h"

namespace fastlio
{
namespace detail
{
/** Offsets to the cell of the query and its 26 neighbours: +1 is towards the nearer side of the
 * query's cell on that axis. Those on nearer sides come first, fewer steps before more. */
constexpr std::int8_t kNeighborOrder[27][3] = {
    {0, 0, 0},   {1, 0, 0},   {0, 1, 0},   {0, 0, 1},   {1, 1, 0},   {1, 0, 1},   {0, 1, 1},
    {1, 1, 1},   {-1, 0, 0},  {0, -1, 0},  {0, 0, -1},  {-1, 1, 0},  {-1, 0, 1},  {1, -1, 0},
    {0, -1, 1},  {1, 0, -1},  {0, 1, -1},  {-1, 1, 1},  {1, -1, 1},  {1, 1, -1},  {-1, -1, 0},
    {-1, 0, -1}, {0, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, -1}};

/** One axis of a query's surroundings: index 0 is the cell itself, 1 the neighbour on the nearer
 * side, 2 the other one. */
struct AxisNeighbors
{
  std::int32_t step[3];   //!< to the cell
  double squared_gap[3];  //!< to the cell's interval [m^2]
  double margin_beyond;   //!< from the query to the nearer end of the three cells [m]
};

[[nodiscard]] inline AxisNeighbors axisNeighbors(
    const CellGrid& grid, double coordinate, std::int32_t cell)
{
  const double below = squaredGap(coordinate, grid.interval(cell - 1, 1));
  const double above = squaredGap(coordinate, grid.interval(cell + 1, 1));
  // The ends of the three cells without the margin, which would widen them.
  const double low = (cell - 1) * grid.cellSize(), high = (cell + 2) * grid.cellSize();
  const double beyond = std::min(coordinate - low, high - coordinate) - grid.margin();
  const double here = squaredGap(coordinate, grid.interval(cell, 1));
  if (below < above) return {{0, -1, 1}, {here, below, above}, beyond};
  return {{0, 1, -1}, {here, above, below}, beyond};
}

/** Squared gaps [m^2] from a coordinate to the cells of a block on one axis. */
struct BlockGaps
{
  double squared_gap[kBlockEdge];
  [[nodiscard]] double operator[](std::int32_t cell) const { return squared_gap[cell]; }
};

[[nodiscard]] inline BlockGaps squaredGaps(
    const CellGrid& grid, double coordinate, std::int32_t first)
{
  BlockGaps gaps;
  for (std::int32_t i = 0; i < kBlockEdge; ++i)
  {
    gaps.squared_gap[i] = squaredGap(coordinate, grid.interval(first + i, 1));
  }
  return gaps;
}

/** Position of an entry of kNeighborOrder in AxisNeighbors. */
[[nodiscard]] constexpr int axisEntry(std::int8_t offset)
{
  return offset < 0 ? 2 : offset;
}
}  // namespace detail

/** At most 2x2x2 blocks contain the 27 cells around a cell. */
class PointIndex::Surroundings
{
 public:
  Surroundings(const PointIndex& index, const GridCoord& home)
      : index_(index), first_(blockOf({home.x - 1, home.y - 1, home.z - 1}))
  {
  }

  /** The cell, or nothing when it is empty. */
  [[nodiscard]] const Cell* find(const GridCoord& cell)
  {
    const GridCoord coord = blockOf(cell);
    const int i = (coord.x - first_.x) | (coord.y - first_.y) << 1 | (coord.z - first_.z) << 2;
    if ((looked_up_ & (1U << i)) == 0) lookUp(i, coord);
    const Block* block = blocks_[i];
    const std::uint32_t c = cellInBlock(cell);
    return block != nullptr && ((block->occupied >> c) & 1U) != 0 ? &block->cells[c] : nullptr;
  }

 private:
  void lookUp(int i, const GridCoord& coord)
  {
    const std::uint32_t number = index_.blockNumber(coord);
    blocks_[i] = number == kNowhere ? nullptr : &index_.blocks_[number];
    looked_up_ |= 1U << i;
  }

  const PointIndex& index_;
  GridCoord first_;
  std::uint32_t looked_up_ = 0;
  const Block* blocks_[8];
};

template <class Collector>
void PointIndex::searchCell(const Cell& cell, const Point3& query, Collector& collector) const
{
  for (std::uint32_t c = cell.head; c != kNowhere; c = links_[c].next)
  {
    const Chunk& chunk = chunks_[c];
    float d[kChunkSize];
    for (std::uint32_t i = 0; i < kChunkSize; ++i)
    {
      d[i] = squaredDistance({chunk.x[i], chunk.y[i], chunk.z[i]}, query);
    }
    // Most places are too far away; sorting them out without branches costs least.
    const float bound = collector.bound();
    std::uint32_t candidates = 0;
    for (std::uint32_t i = 0; i < kChunkSize; ++i)
    {
      candidates |= static_cast<std::uint32_t>(d[i] <= bound) << i;
    }
    for (; candidates != 0; candidates &= candidates - 1)
    {
      const auto i = static_cast<std::uint32_t>(__builtin_ctz(candidates));
      if (!(d[i] <= collector.bound())) continue;
      collector.offer({chunk.x[i], chunk.y[i], chunk.z[i], d[i], chunk.point[i]});
    }
    if (cell.count <= kChunkSize) return;
  }
}

/** The query's cell and its 26 neighbours.
 * \return distance [m] around the query within which every point has been offered; negative when
 * the query lies outside of the numbered space */
template <class Collector>
double PointIndex::searchSurroundings(
    const Point3& query, const GridCoord& home, Collector& collector) const
{
  const detail::AxisNeighbors axes[3] = {
      detail::axisNeighbors(grid_, query.x, home.x), detail::axisNeighbors(grid_, query.y, home.y),
      detail::axisNeighbors(grid_, query.z, home.z)};
  Surroundings surroundings(*this, home);
  for (const auto& offset : detail::kNeighborOrder)
  {
    const int i = detail::axisEntry(offset[0]);
    const int j = detail::axisEntry(offset[1]);
    const int k = detail::axisEntry(offset[2]);
    const float bound =
        CellGrid::shrink(axes[0].squared_gap[i] + axes[1].squared_gap[j] + axes[2].squared_gap[k]);
    if (bound > collector.bound()) continue;
    const Cell* cell =
        surroundings.find(home + GridCoord{axes[0].step[i], axes[1].step[j], axes[2].step[k]});
    if (cell != nullptr) searchCell(*cell, query, collector);
  }
  return std::min({axes[0].margin_beyond, axes[1].margin_beyond, axes[2].margin_beyond});
}

/** All cells of a block but those that searchSurroundings() visits. */
template <class Collector>
void PointIndex::searchBlock(
    const Block& block, const Point3& query, const GridCoord& home, Collector& collector) const
{
  const GridCoord first = firstCell(block.coord);
  const auto x = detail::squaredGaps(grid_, query.x, first.x);
  const auto y = detail::squaredGaps(grid_, query.y, first.y);
  const auto z = detail::squaredGaps(grid_, query.z, first.z);
  for (std::uint64_t left = block.occupied; left != 0; left &= left - 1)
  {
    const auto c = static_cast<std::uint32_t>(__builtin_ctzll(left));
    const GridCoord in_block = cellOfBlock({}, c);
    const double gap = x[in_block.x] + y[in_block.y] + z[in_block.z];
    if (CellGrid::shrink(gap) > collector.bound()) continue;
    const GridCoord cell = first + in_block;
    const bool visited = std::abs(cell.x - home.x) <= 1 && std::abs(cell.y - home.y) <= 1 &&
                         std::abs(cell.z - home.z) <= 1;
    if (!visited) searchCell(block.cells[c], query, collector);
  }
}

/** What lies outside of the 27 cells: the blocks that the bound reaches, or simply all blocks when
 * that would be more. */
template <class Collector>
void PointIndex::searchBeyond(
    const Point3& query, const GridCoord& home, Collector& collector) const
{
  const double reach = std::sqrt(static_cast<double>(collector.bound()));
  const BlockRange range = grid_.blocksWithin(query, reach);
  const auto may_hold = [&](const GridCoord& coord)
  { return grid_.lowerBound(query, firstCell(coord), kBlockEdge) <= collector.bound(); };
  if (range.count() > static_cast<double>(blocks_by_key_.size()))
  {
    for (const auto& entry : blocks_by_key_)
    {
      if (!may_hold(blocks_[entry.second].coord)) continue;
      searchBlock(blocks_[entry.second], query, home, collector);
    }
    return;
  }
  range.forEach(
      [&](const GridCoord& coord)
      {
        if (!may_hold(coord)) return;
        const std::uint32_t number = blockNumber(coord);
        if (number != kNowhere) searchBlock(blocks_[number], query, home, collector);
      });
}

template <class Collector>
void PointIndex::search(const Point3& query, Collector& collector) const
{
  const GridCoord home = grid_.cellOf(query);
  const double seen = searchSurroundings(query, home, collector);
  if (seen > 0 && collector.bound() <= CellGrid::shrink(seen * seen)) return;
  searchBeyond(query, home, collector);
}

}  // namespace fastlio
