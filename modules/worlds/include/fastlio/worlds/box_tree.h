// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file box_tree.h The boxes around bodies, four to a node: which bodies can rays meet? */
#pragma once

#include <fastlio/worlds/four_boxes.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
class TracedBundle;
struct Leaves;

/** A bounding volume hierarchy. Four boxes are tested at once, and for all rays of a bundle at
 * once. */
class BoxTree
{
 public:
  BoxTree() = default;

  explicit BoxTree(const std::vector<Primitive>& bodies);

  /** The rays meet the bodies that they can reach. \param rays of one octant, see
   * RayBundle::isOfOneOctant() \param bodies those of the tree */
  void cast(const std::vector<Primitive>& bodies, TracedBundle& rays) const;

 private:
  struct Node
  {
    FourBoxes boxes;
    std::array<std::uint32_t, FourBoxes::kCount> inside{};  //!< number of a node or of a body
    std::array<bool, FourBoxes::kCount> is_body{};
  };

  std::uint32_t build(const Leaves& leaves, std::size_t level);

  std::vector<Node> nodes_;
};

}  // namespace fastlio
