// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file free_space.h Which parts of a map are free space most of the time: what was seen there has
 * moved away. */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/math/so3.h>
#include <fastlio/parallel/workers.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Rays of a scan in the world, all columns of equal length. */
struct ScanRays
{
  std::int64_t stamp_ns = 0;                                     //!< end of the scan
  WorldPoints ends;                                              //!< what they hit [m]
  Vec3 first_origin = Vec3::Zero(), last_origin = Vec3::Zero();  //!< of the LiDAR [m]
  /** Where the LiDAR was when the ray was measured: 0 at the first origin, 1 at the last one. */
  std::vector<float> fraction;
};

/** When a voxel counts as free. */
struct FreeSpaceRule
{
  double voxel = 0.2;  //!< edge [m]
  /** A ray says something about a voxel when it passes its points so near [m]: rays pass beside
   * poles and above the ground within a voxel. */
  double nearness = 0.08;
  double end = 0.4;             //!< the last part of a ray says nothing [m]
  double start = 1.0;           //!< nor does the first one: the carrier [m]
  double reach = 40.0;          //!< nor what is farther: the ray's place is not certain [m]
  double passes_per_hit = 3.0;  //!< scans that have to pass for each one that hits
  double passes_beside = 1.0;   //!< likewise beside voxels that are free
  double free_beside = 3.0;     //!< so many of the 26 around
  double least_passes = 4.0;    //!< but not fewer
  double waiting = 20.0;        //!< rays vote on what was hit up to so much later [s]
  std::size_t waiting_points = 4'000'000;  //!< of rays that wait, at most
  std::size_t most_voxels = 8'000'000;     //!< with votes in memory: 64 bytes each
};

/** Votes of rays on the voxels of a map. Each scan has one vote on a voxel: occupied if it has a
 * point there, free if a ray passes by where the voxel's points are. A voxel is free when enough
 * more scans say so than say that it is occupied.
 *
 * A surface at grazing incidence is passed closely by the rays that hit it a bit farther; so the
 * length of a ray's end that has no vote grows with the slant of the surface at its end. Beyond
 * FreeSpaceRule::most_voxels, the votes on what was not seen for longest are counted and forgotten;
 * the latest count of a voxel holds. Not thread-safe. */
class FreeSpaceVotes
{
 public:
  /** \param workers who share the work; the result does not depend on them
   * \exception std::invalid_argument a length of the rule is not positive */
  explicit FreeSpaceVotes(
      FreeSpaceRule rule = {},
      std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));
  ~FreeSpaceVotes();
  FreeSpaceVotes(const FreeSpaceVotes&) = delete;
  FreeSpaceVotes& operator=(const FreeSpaceVotes&) = delete;

  /** Takes one scan. Scans come in time order; a new session may begin at any time. */
  void add(ScanRays rays);

  /** Counts all votes. No scan may be added any more. */
  void finish();

  /** Whether a point is in a voxel that is free, as counted so far [m]. */
  [[nodiscard]] bool isFree(float x, float y, float z) const;

  /** Voxels that are free, as counted so far. */
  [[nodiscard]] std::size_t freeVoxels() const;
  /** Voxels whose votes are in memory. */
  [[nodiscard]] std::size_t voxelsInMemory() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastlio
