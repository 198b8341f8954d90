// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/pointmap/incremental_points_map.h>
#include <fastlio/run/output_map.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
/** Points stay whole when the memory does not suffice: all fields have room before one grows. */
void makeRoom(OutputPoints& points, std::size_t more)
{
  const std::size_t size = points.size() + more;
  const auto grow = [size](auto& field)
  {
    if (field.capacity() < size) field.reserve(std::max(size, 2 * field.capacity()));
  };
  grow(points.x);
  grow(points.y);
  grow(points.z);
  grow(points.intensity);
  grow(points.stamp_ns);
}

void append(OutputPoints& to, const OutputPoints& from, std::size_t i)
{
  to.add(from.x[i], from.y[i], from.z[i]);
  to.intensity.push_back(from.intensity[i]);
  to.stamp_ns.push_back(from.stamp_ns[i]);
}
}  // namespace

void OutputPoints::resize(std::size_t n)
{
  WorldPoints::resize(n);
  intensity.resize(n);
  stamp_ns.resize(n);
}

/** Either in memory (index) or in a file. */
struct OutputMap::Tile
{
  std::unique_ptr<CIncrementalPointsMap> index;
  OutputPoints points;
  std::size_t size = 0;
  std::uint64_t last_insertion = 0;
  ScratchFile file;
};

OutputMap::OutputMap(OutputMapOptions options)
    : options_(std::move(options)), folder_(ScratchContent::MapTiles, options_.directory)
{
  if (!(options_.spacing >= 0.0) || !(options_.tile_size > 0.0))
    throw std::invalid_argument(
        "OutputMap: the spacing must not be negative and the tile size must be positive; seen " +
        std::to_string(options_.spacing) + " and " + std::to_string(options_.tile_size));
}

OutputMap::~OutputMap() = default;

std::map<OutputMap::Key, OutputPoints> OutputMap::byTile(const OutputPoints& points) const
{
  std::map<Key, OutputPoints> tiles;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    // Tiles are numbered by int.
    if (!CIncrementalPointsMap::isPlace(points.x[i], points.y[i], points.z[i])) continue;
    const Key key(
        static_cast<int>(std::floor(points.x[i] / options_.tile_size)),
        static_cast<int>(std::floor(points.y[i] / options_.tile_size)));
    append(tiles[key], points, i);
  }
  return tiles;
}

void OutputMap::insert(const OutputPoints& points)
{
  ++insertions_;
  for (const auto& [key, part] : byTile(points))
  {
    auto place = tiles_.find(key);
    if (place == tiles_.end()) place = tiles_.emplace(key, std::make_unique<Tile>()).first;
    Tile& tile = *place->second;
    tile.last_insertion = insertions_;
    restore(tile);
    addTo(tile, part);
  }
  keepWithinMemory();
}

void OutputMap::restore(Tile& tile)
{
  if (tile.index) return;
  auto index = std::make_unique<CIncrementalPointsMap>(options_.spacing);
  if (tile.size > 0)
  {
    OutputPoints points = readBack(tile);
    index->insertPoints(points.x.data(), points.y.data(), points.z.data(), tile.size);
    tile.points = std::move(points);
    in_memory_ += tile.size;
  }
  tile.index = std::move(index);
}

void OutputMap::addTo(Tile& tile, const OutputPoints& points)
{
  const std::size_t before = tile.index->size();
  makeRoom(tile.points, points.size());
  tile.index->insertPoints(points.x.data(), points.y.data(), points.z.data(), points.size());
  const auto& x = tile.index->getPointsBufferRef_x();
  const auto& y = tile.index->getPointsBufferRef_y();
  const auto& z = tile.index->getPointsBufferRef_z();
  // The index keeps a part of the points, in their order.
  std::size_t kept = before;
  for (std::size_t i = 0; i < points.size() && kept < x.size(); ++i)
  {
    if (points.x[i] != x[kept] || points.y[i] != y[kept] || points.z[i] != z[kept]) continue;
    append(tile.points, points, i);
    ++kept;
  }
  tile.size = tile.points.size();
  size_ += kept - before;
  in_memory_ += kept - before;
}

void OutputMap::store(const Key& key, Tile& tile)
{
  const OutputPoints& p = tile.points;
  tile.file = folder_.write(
      std::to_string(key.first) + "_" + std::to_string(key.second), p.x, p.y, p.z, p.intensity,
      p.stamp_ns);
  in_memory_ -= tile.size;
  tile.points = {};
  tile.index.reset();
}

OutputPoints OutputMap::readBack(const Tile& tile) const
{
  OutputPoints p;
  p.resize(tile.size);
  folder_.read(tile.file, p.x, p.y, p.z, p.intensity, p.stamp_ns);
  return p;
}

void OutputMap::keepWithinMemory()
{
  while (in_memory_ > options_.points_in_memory)
  {
    auto oldest = tiles_.end();
    for (auto it = tiles_.begin(); it != tiles_.end(); ++it)
    {
      const Tile& tile = *it->second;
      if (!tile.index || tile.size == 0 || tile.last_insertion == insertions_) continue;
      if (oldest == tiles_.end() || tile.last_insertion < oldest->second->last_insertion)
        oldest = it;
    }
    if (oldest == tiles_.end()) return;
    store(oldest->first, *oldest->second);
  }
}

void OutputMap::forEachTile(const std::function<void(const OutputPoints&)>& use) const
{
  for (const auto& [key, tile] : tiles_)
  {
    if (tile->size == 0) continue;  // there was no memory for its points
    if (tile->index)
      use(tile->points);
    else
      use(readBack(*tile));
  }
}

}  // namespace fastlio
