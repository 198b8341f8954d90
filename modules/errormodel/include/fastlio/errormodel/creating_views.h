// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file creating_views.h From where the planes of the map were seen when they were created. */
#pragma once

#include <fastlio/math/pose.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Where the LiDAR was at each insertion. */
class CreatingViews
{
 public:
  /** \param insertion its number, greater than that before */
  void record(std::uint32_t insertion, const Pose& T_world_lidar);
  void clear() { views_.clear(); }

  /** The world seen from the LiDAR then, or from where it was shortly before; nullptr: not known.
   */
  [[nodiscard]] const Pose* T_lidar_world(std::uint32_t insertion) const;

 private:
  struct View
  {
    std::uint32_t scan = 0;  // number of the insertion
    Pose T_lidar_world;
  };
  std::vector<View> views_;  // ascending
};

}  // namespace fastlio
