// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "insertion_weights.h"
#include <fastlio/errormodel/creating_views.h>

#include <algorithm>

namespace fastlio
{
void CreatingViews::record(std::uint32_t insertion, const Pose& T_world_lidar)
{
  if (views_.size() >= kMaxInsertions) keepEverySecond(views_);
  views_.push_back({insertion, T_world_lidar.inverse()});
}

const Pose* CreatingViews::T_lidar_world(std::uint32_t insertion) const
{
  const auto next = std::upper_bound(
      views_.begin(), views_.end(), insertion,
      [](std::uint32_t number, const View& view) { return number < view.insertion; });
  return next == views_.begin() ? nullptr : &std::prev(next)->T_lidar_world;
}

}  // namespace fastlio
