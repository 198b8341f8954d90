// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "insertion_weights.h"
#include <fastlio/errormodel/creating_views.h>

namespace fastlio
{
void CreatingViews::record(std::uint32_t insertion, const Pose& T_world_lidar)
{
  if (views_.size() >= kMaxInsertions) keepEverySecond(views_);
  views_.push_back({insertion, T_world_lidar.inverse()});
}

const Pose* CreatingViews::T_lidar_world(std::uint32_t insertion) const
{
  const std::size_t index = indexOfInsertion(views_, insertion);
  return index < views_.size() ? &views_[index].T_lidar_world : nullptr;
}

}  // namespace fastlio
