// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_index.h"

#include <limits>

namespace fastlio
{
namespace
{
/** Extremes of the distance from a point to a cube [m], squared. */
struct DistanceRange
{
  double nearest_sqr = 0, farthest_sqr = 0;
};

DistanceRange distanceRange(
    const CellGrid& grid, const double (&center)[3], const GridCoord& first, std::int32_t cells)
{
  const std::int32_t firsts[3] = {first.x, first.y, first.z};
  DistanceRange range;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Interval side = grid.interval(firsts[axis], cells);
    const double far = std::max(center[axis] - side.low, side.high - center[axis]);
    range.nearest_sqr += squaredGap(center[axis], side);
    range.farthest_sqr += far * far;
  }
  return range;
}

double squaredDistance(const double (&center)[3], double x, double y, double z)
{
  const double dx = x - center[0], dy = y - center[1], dz = z - center[2];
  return dx * dx + dy * dy + dz * dz;
}
}  // namespace

PointIndex::Chunk::Chunk()
{
  constexpr float kUnused = std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < kChunkSize; ++i)
  {
    x[i] = y[i] = z[i] = kUnused;
    point[i] = kNowhere;
  }
}

std::size_t PointIndex::memoryBytes() const
{
  constexpr std::size_t kHashBucket = 24;  // robin_map: key, value, distance
  return blocks_.memoryBytes() + chunks_.memoryBytes() + links_.capacity() * sizeof(ChunkLink) +
         place_of_.capacity() * sizeof(std::uint32_t) + blocks_by_key_.bucket_count() * kHashBucket;
}

std::uint32_t PointIndex::blockNumber(const GridCoord& coord) const
{
  const auto found = blocks_by_key_.find(blockKey(coord));
  return found == blocks_by_key_.end() ? kNowhere : found->second;
}

std::uint32_t PointIndex::obtainBlock(const GridCoord& coord)
{
  const std::uint32_t existing = blockNumber(coord);
  if (existing != kNowhere) return existing;
  const std::uint32_t number = blocks_.acquire();
  blocks_[number].coord = coord;
  blocks_by_key_.emplace(blockKey(coord), number);
  return number;
}

std::uint32_t PointIndex::pushChunk(std::uint32_t block, std::uint32_t cell)
{
  const std::uint32_t chunk = chunks_.acquire();
  if (chunk >= links_.size()) links_.resize(chunk + std::size_t{1});
  links_[chunk] = {blocks_[block].cells[cell].head, block, cell};
  blocks_[block].cells[cell].head = chunk;
  blocks_[block].occupied |= std::uint64_t{1} << cell;
  return chunk;
}

void PointIndex::add(std::uint32_t point, const Point3& p)
{
  const GridCoord coord = grid_.cellOf(p);
  const std::uint32_t block = obtainBlock(blockOf(coord));
  const std::uint32_t c = cellInBlock(coord);
  Cell& cell = blocks_[block].cells[c];
  const std::uint32_t place = cell.count & (kChunkSize - 1U);
  const std::uint32_t chunk_number = place == 0 ? pushChunk(block, c) : cell.head;
  Chunk& chunk = chunks_[chunk_number];
  chunk.x[place] = p.x;
  chunk.y[place] = p.y;
  chunk.z[place] = p.z;
  chunk.point[place] = point;
  ++cell.count;
  ++size_;
  if (point >= place_of_.size()) place_of_.resize(point + std::size_t{1}, kNowhere);
  place_of_[point] = chunk_number << kChunkBits | place;
}

/** Gives up the last place of a cell, and what gets empty by that. */
void PointIndex::popPlace(std::uint32_t block_number, std::uint32_t cell_number)
{
  Block& block = blocks_[block_number];
  Cell& cell = block.cells[cell_number];
  const std::uint32_t place = --cell.count & (kChunkSize - 1U);
  if (place != 0)
  {
    chunks_[cell.head].x[place] = std::numeric_limits<float>::infinity();
    return;
  }
  const std::uint32_t emptied = cell.head;
  cell.head = links_[emptied].next;
  chunks_.release(emptied);
  if (cell.count != 0) return;
  block.occupied &= ~(std::uint64_t{1} << cell_number);
  if (block.occupied != 0) return;
  blocks_by_key_.erase(blockKey(block.coord));
  blocks_.release(block_number);
}

void PointIndex::remove(std::uint32_t point)
{
  const std::uint32_t hole = place_of_[point];
  const std::uint32_t hole_chunk = hole >> kChunkBits, i = hole & (kChunkSize - 1U);
  const ChunkLink link = links_[hole_chunk];
  const Cell& cell = blocks_[link.block].cells[link.cell];
  const std::uint32_t j = (cell.count - 1U) & (kChunkSize - 1U);
  const Chunk& last = chunks_[cell.head];
  Chunk& chunk = chunks_[hole_chunk];
  chunk.x[i] = last.x[j];
  chunk.y[i] = last.y[j];
  chunk.z[i] = last.z[j];
  chunk.point[i] = last.point[j];
  place_of_[chunk.point[i]] = hole;
  place_of_[point] = kNowhere;
  popPlace(link.block, link.cell);
  --size_;
}

void PointIndex::rename(std::uint32_t from, std::uint32_t to)
{
  const std::uint32_t place = place_of_[from];
  chunks_[place >> kChunkBits].point[place & (kChunkSize - 1U)] = to;
  place_of_[from] = kNowhere;
  place_of_[to] = place;
}

void PointIndex::appendOutside(
    const Block& block, const double (&center)[3], double radius,
    std::vector<std::uint32_t>& outside) const
{
  for (std::uint64_t left = block.occupied; left != 0; left &= left - 1)
  {
    const Cell& cell = block.cells[__builtin_ctzll(left)];
    std::uint32_t count = (cell.count - 1U) % kChunkSize + 1U;  // of the head; others are full
    for (std::uint32_t c = cell.head; c != kNowhere; c = links_[c].next, count = kChunkSize)
    {
      const Chunk& chunk = chunks_[c];
      for (std::uint32_t i = 0; i < count; ++i)
      {
        const double d = squaredDistance(center, chunk.x[i], chunk.y[i], chunk.z[i]);
        if (d > radius * radius) outside.push_back(chunk.point[i]);
      }
    }
  }
}

std::vector<std::uint32_t> PointIndex::pointsOutside(
    double x, double y, double z, double radius) const
{
  const double center[3] = {x, y, z};
  std::vector<std::uint32_t> outside;
  for (const auto& entry : blocks_by_key_)
  {
    const Block& block = blocks_[entry.second];
    const DistanceRange range = distanceRange(grid_, center, firstCell(block.coord), kBlockEdge);
    if (range.farthest_sqr > radius * radius) appendOutside(block, center, radius, outside);
  }
  return outside;
}

}  // namespace fastlio
