// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_tree.h Planes of a submap, and the search for those beside a point (internal). */
#pragma once

#include <fastlio/map/plane_voxel.h>
#include <fastlio/math/so3.h>

#include <nanoflann.hpp>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** A plane with what is used most in double precision. It is a copy: planes may come from a
 * temporary. */
struct Patch
{
  Vec3 normal, centroid;
  VoxelPlane plane;
};

[[nodiscard]] inline std::vector<Patch> patchesOf(const std::vector<VoxelPlane>& planes)
{
  std::vector<Patch> patches;
  patches.reserve(planes.size());
  for (const VoxelPlane& plane : planes)
    patches.push_back({plane.normal(), plane.centroid(), plane});
  return patches;
}

/** The tree's view of the centroids. */
struct CentroidCloud
{
  std::vector<Patch> patches;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return patches.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const
  {
    return patches[i].centroid[static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const
  {
    return false;
  }
};

using PlaneTree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, CentroidCloud>, CentroidCloud, 3, std::size_t>;

}  // namespace fastlio
