// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file output_map.h The map that is saved: denser than what scans are matched with, and as large
 * as the disk. */
#pragma once

#include <fastlio/files/scratch_folder.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/math/so3.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace fastlio
{
class CIncrementalPointsMap;

/** Points in the world frame, counted from the map's origin, and what was measured with them, as
 * columns of equal length. */
struct OutputPoints : WorldPoints, RegisteredFields
{
  void resize(std::size_t n);
};

/** Options of an OutputMap. */
struct OutputMapOptions
{
  double spacing = 0.1;                      //!< least distance of points within a tile [m]; 0: any
  double tile_size = 50.0;                   //!< edge of a tile, a column of the world [m]
  std::size_t points_in_memory = 5'000'000;  //!< beyond it, tiles go to files
  std::string directory;                     //!< for these files; empty: the system's own place
  Vec3 origin = Vec3::Zero();                //!< what points are counted from, in the world [m]
};

/** Points in square tiles of the world. When there are more points than may stay in memory, the
 * tiles that were not added to for longest move to files in a folder that is removed in the end;
 * they come back when points are added to them. What was added by the latest insert() always stays.
 *
 * A point is left out when the tile has one nearer than the spacing. Not thread-safe. */
class OutputMap
{
 public:
  /** \exception std::invalid_argument spacing or tile size out of range */
  explicit OutputMap(OutputMapOptions options = {});
  ~OutputMap();
  OutputMap(const OutputMap&) = delete;
  OutputMap& operator=(const OutputMap&) = delete;

  /** Adds points; those that are not finite, or farther than 10000 km from the origin, are left
   * out.
   * \exception std::runtime_error a tile cannot be written to disk or read back */
  void insert(const OutputPoints& points);

  [[nodiscard]] const Vec3& origin() const { return options_.origin; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t pointsInMemory() const { return in_memory_; }

  /** Hands over every tile once, always in the same order; only one at a time is in memory beside
   * those that are there anyway.
   * \exception std::runtime_error a tile cannot be read back */
  void forEachTile(const std::function<void(const OutputPoints&)>& use) const;

 private:
  using Key = std::pair<int, int>;
  struct Tile;

  [[nodiscard]] std::map<Key, OutputPoints> byTile(const OutputPoints& points) const;
  void addTo(Tile& tile, const OutputPoints& points);
  void restore(Tile& tile);
  void store(const Key& key, Tile& tile);
  void keepWithinMemory();
  [[nodiscard]] OutputPoints readBack(const Tile& tile) const;

  OutputMapOptions options_;
  std::map<Key, std::unique_ptr<Tile>> tiles_;
  std::size_t size_ = 0, in_memory_ = 0;
  std::uint64_t insertions_ = 0;
  ScratchFolder folder_;
};

}  // namespace fastlio
