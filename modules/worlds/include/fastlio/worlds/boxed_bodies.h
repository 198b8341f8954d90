// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file boxed_bodies.h A few bodies that come and go, in a list with the boxes around them. */
#pragma once

#include <fastlio/worlds/four_boxes.h>

#include <vector>

namespace fastlio
{
/** Boxes in a list, four by four. */
class BoxList
{
 public:
  void clear() { fours_.clear(), count_ = 0; }

  void add(const Bounds& box)
  {
    const std::size_t slot = count_++ % FourBoxes::kCount;
    if (slot == 0) fours_.emplace_back();
    fours_.back().set(slot, box);
  }

  /** The boxes in their order; those that fill up the last four are empty. */
  [[nodiscard]] const std::vector<FourBoxes>& fours() const { return fours_; }

 private:
  std::vector<FourBoxes> fours_;
  std::size_t count_ = 0;
};

/** Bodies in a list, for those that are no part of a World. */
class BoxedBodies
{
 public:
  void clear() { bodies_.clear(), boxes_.clear(); }

  void add(const Primitive& body)
  {
    bodies_.push_back(body);
    boxes_.add(boundsOf(body));
  }

  [[nodiscard]] const std::vector<Primitive>& bodies() const { return bodies_; }
  [[nodiscard]] const BoxList& boxes() const { return boxes_; }

 private:
  std::vector<Primitive> bodies_;
  BoxList boxes_;
};

}  // namespace fastlio
