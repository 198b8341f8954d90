// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file moving_objects.h A map without what moved while it was recorded. */
#pragma once

#include <fastlio/freespace/free_space.h>
#include <fastlio/mapping/map_builder.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace fastlio
{
/** How many points of the scans went. */
struct RemovedPoints
{
  std::size_t points = 0;   //!< of all scans
  std::size_t removed = 0;  //!< of them, in free space
  std::size_t voxels = 0;   //!< that are free
};

/** For people. */
[[nodiscard]] std::string removalSentence(const RemovedPoints& counts);

/** Removes moving objects: first the rays of all sessions vote on the corrected map, then the
 * points of each scan are looked up. Not thread-safe. */
class MovingObjects
{
 public:
  /** \param workers who share the work; the result does not depend on them */
  explicit MovingObjects(std::shared_ptr<const Workers> workers, FreeSpaceRule rule = {});

  /** \exception std::invalid_argument the session has several LiDARs: which of them a ray comes
   * from is not known */
  static void requireOneLidar(const Session& session);

  /** A pass over a session: its rays vote. \return false when it was interrupted
   * \exception std::invalid_argument as requireOneLidar() */
  bool vote(
      const Session& session, std::size_t number, const BuiltMap& map, const PassHooks& hooks = {});

  /** After the last vote. */
  void finish();

  /** The scan without its points in free space. Valid until the next call. */
  [[nodiscard]] PlacedScan withoutMoving(const PlacedScan& scan);

  [[nodiscard]] const RemovedPoints& counts() const { return counts_; }

 private:
  FreeSpaceVotes votes_;
  RemovedPoints counts_;
  WorldPoints kept_points_;
  RegisteredFields kept_fields_;
};

}  // namespace fastlio
