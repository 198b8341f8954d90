// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file four_boxes.h Four boxes side by side, as registers take them. */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace fastlio
{
/** Four axis-aligned boxes; those that are not set are empty. */
class FourBoxes
{
 public:
  static constexpr std::size_t kCount = 4;
  using Numbers = Eigen::Array<double, kCount, 1>;  //!< one for each box

  FourBoxes()
  {
    for (std::size_t slot = 0; slot < kCount; ++slot)
      set(slot, Bounds{});
  }

  void set(std::size_t slot, const Bounds& box)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sides_[axis][0][static_cast<Eigen::Index>(slot)] = box.min[static_cast<Eigen::Index>(axis)];
      sides_[axis][1][static_cast<Eigen::Index>(slot)] = box.max[static_cast<Eigen::Index>(axis)];
    }
  }

  /** Coordinates [m] of the sides across an axis. \param side 0: the lesser, 1: the greater */
  [[nodiscard]] const Numbers& sides(std::size_t axis, std::size_t side) const
  {
    return sides_[axis][side];
  }

 private:
  std::array<std::array<Numbers, 2>, 3> sides_;
};

}  // namespace fastlio
