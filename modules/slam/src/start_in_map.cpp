// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "start_in_map.h"

#include <fastlio/map/surface_map.h>
#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/math/angles.h>

#include <memory>
#include <stdexcept>

namespace fastlio
{
SavedMap savedMapOf(const Odometry& odometry)
{
  SavedMap saved;
  saved.origin = odometry.mapOrigin();
  if (const auto* planes = dynamic_cast<const VoxelPlaneMap*>(&odometry.map()))
    saved.planes = std::make_shared<const VoxelPlaneMap>(*planes);
  const auto points = odometry.map().toPointsMap();
  const auto &x = points->getPointsBufferRef_x(), &y = points->getPointsBufferRef_y(),
             &z = points->getPointsBufferRef_z();
  saved.points.x.assign(x.begin(), x.end());
  saved.points.y.assign(y.begin(), y.end());
  saved.points.z.assign(z.begin(), z.end());
  return saved;
}

void requireUsable(const VehicleGuess& guess)
{
  constexpr double kMostPosition = 100.0;  // as initialization.pose_position_std
  const auto within = [](double value, double most) { return value >= 0.0 && value <= most; };
  if (!guess.T_map_vehicle.R.allFinite() || !guess.T_map_vehicle.p.allFinite() ||
      !within(guess.position_std, kMostPosition) || !within(guess.yaw_std, 180.0 * kRadPerDeg))
    throw std::invalid_argument(
        "a pose to start at must be finite, its standard deviations 0 to 100 m and 0 to 180 deg");
}

}  // namespace fastlio
