// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_tree.h Planes of a submap, and the search for those beside a point (internal). */
#pragma once

#include <fastlio/map/plane_voxel.h>
#include <fastlio/math/so3.h>

#include <nanoflann.hpp>

#include <array>
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

/** A result set for the tree: the nearest \a Most within a reach, the nearest first. Without the
 * reach the tree would visit most of its leaves where nothing is near. */
template <std::size_t Most>
class NearestWithin
{
 public:
  // The names are those that nanoflann asks for.
  using DistanceType = double;
  using IndexType = std::size_t;
  using CountType = std::size_t;

  explicit NearestWithin(double squared_reach) : squared_reach_(squared_reach) {}

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] bool full() const { return count_ == Most; }
  [[nodiscard]] double worstDist() const { return full() ? distances_.back() : squared_reach_; }
  /** \return true: the search goes on */
  bool addPoint(double distance, std::size_t index)
  {
    if (distance >= worstDist()) return true;
    std::size_t i = full() ? Most - 1 : count_++;
    for (; Most > 1 && i > 0 && distances_[i - 1] > distance; --i)
    {
      distances_[i] = distances_[i - 1];
      indices_[i] = indices_[i - 1];
    }
    distances_[i] = distance;
    indices_[i] = index;
    return true;
  }
  void sort() const {}  // they are

  [[nodiscard]] std::size_t operator[](std::size_t i) const { return indices_[i]; }

 private:
  double squared_reach_;
  std::size_t count_ = 0;
  std::array<double, Most> distances_{};
  std::array<std::size_t, Most> indices_{};
};

template <std::size_t Most>
[[nodiscard]] NearestWithin<Most> nearestWithin(
    const PlaneTree& tree, const Vec3& point, double reach)
{
  NearestWithin<Most> nearest(reach * reach);
#if NANOFLANN_VERSION < 0x150
  tree.findNeighbors(nearest, point.data(), nanoflann::SearchParams());
#else
  tree.findNeighbors(nearest, point.data());
#endif
  return nearest;
}

}  // namespace fastlio
