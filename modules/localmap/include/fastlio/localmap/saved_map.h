// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file saved_map.h A map of an earlier run to start in. */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/math/pose.h>

#include <memory>

namespace fastlio
{
class VoxelPlaneMap;

/** A map and about where the platform is in it. Its z axis points up. */
struct SavedMap
{
  WorldPoints points;  //!< on surfaces, about as dense as map.output_spacing [m]
  /** Origin of points and planes, in the world [m]: single precision has steps of 0.5 m
   * at UTM coordinates. */
  Vec3 origin = Vec3::Zero();
  /** Ready planes, used instead of the points when map.type is planes. */
  std::shared_ptr<const VoxelPlaneMap> planes;
  Pose T_map_imu;  //!< at the start, in the world (not counted from \a origin), within
                   //!< initialization.pose_*_std; only the heading of its attitude counts, the rest
                   //!< is measured with gravity

  [[nodiscard]] bool empty() const { return !planes && points.size() == 0; }
};

/** Adds points of unknown viewpoints to a map: each is taken as seen along the normal of the
 * surface that its neighbours make. Points without such a surface join, too: where they lie, a wide
 * voxel holds more than one plane. */
void insertSavedPoints(const WorldPoints& points, SurfaceMap& map);

}  // namespace fastlio
