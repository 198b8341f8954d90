// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file submap_store.h The planes of submaps: in memory as far as they may be, in files beyond. */
#pragma once

#include <fastlio/files/scratch_folder.h>
#include <fastlio/map/plane_voxel.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The surfaces of a submap. */
struct SubmapSurfaces
{
  std::vector<VoxelPlane> planes;  //!< each surface once; frame of the submap's reference [m]
  std::vector<float> spreads;      //!< of each plane, rms distance of its points across it [m]
};

/** Options of a SubmapStore. */
struct SubmapStoreOptions
{
  /** Beyond so many planes, submaps go to files. */
  std::size_t planes_in_memory = std::numeric_limits<std::size_t>::max();
  std::string directory;  //!< for these files; empty: the system's own place
};

/** What went wrong with the files of a SubmapStore, in sentences; empty: nothing. */
struct SubmapStoreTroubles
{
  /** A submap could not be written: it stays in memory, and so do all that follow. Nothing is lost.
   */
  std::string not_written;
  /** A submap could not be read back, the first of all: its surfaces are lost. */
  std::string not_read;
  std::size_t lost = 0;  //!< submaps whose surfaces are
};

/** Holds the surfaces of submaps. When they have more planes than may stay in memory, those of the
 * submaps that nobody asked for for longest move to files of a folder that is removed in the end;
 * they come back when somebody asks for them. Those that were added or asked for last always stay.
 * May be used by several threads. */
class SubmapStore
{
 public:
  explicit SubmapStore(SubmapStoreOptions options = {});

  [[nodiscard]] std::size_t planesInMemory() const;
  [[nodiscard]] SubmapStoreTroubles troubles() const;

 private:
  friend class StoredSurfaces;

  /** Of one submap. */
  struct Piece
  {
    std::shared_ptr<const SubmapSurfaces> surfaces;  //!< null: in the file only
    std::size_t planes = 0;
    std::optional<ScratchFile> file;  //!< surfaces do not change: it is written once
    std::uint64_t last_use = 0;
  };

  /** \return its number */
  std::size_t add(SubmapSurfaces surfaces);
  std::shared_ptr<const SubmapSurfaces> get(std::size_t number);
  void forget(std::size_t number);
  void load(Piece& piece);
  void keepWithinMemory();
  Piece* leastRecentlyUsed();
  void write(Piece& piece);

  mutable std::mutex mutex_;
  SubmapStoreOptions options_;
  std::map<std::size_t, Piece> pieces_;  //!< by number
  std::size_t added_ = 0;
  std::size_t in_memory_ = 0;  //!< planes
  std::uint64_t uses_ = 0;
  ScratchFolder folder_;
  SubmapStoreTroubles troubles_;
};

/** The surfaces of one submap in a store. Copies share them; the store forgets them with the last
 * copy, and lives as long as there is one. */
class StoredSurfaces
{
 public:
  /** No surfaces. */
  StoredSurfaces() = default;
  /** \exception std::invalid_argument there is not one spread for each plane */
  StoredSurfaces(const std::shared_ptr<SubmapStore>& store, SubmapSurfaces surfaces);

  /** How many planes there are, also while they are in a file. */
  [[nodiscard]] std::size_t planes() const { return planes_; }

  /** The surfaces: out of the file when they are there. What is handed over stays valid as long as
   * it is held.
   * \return without planes where the file cannot be read: SubmapStore::troubles() says why */
  [[nodiscard]] std::shared_ptr<const SubmapSurfaces> get() const;

 private:
  class Entry;

  std::shared_ptr<const Entry> entry_;
  std::size_t planes_ = 0;
};

}  // namespace fastlio
