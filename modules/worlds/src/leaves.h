// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file leaves.h How the boxes of bodies become the branches of a tree (internal). */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** The box around a body. */
struct Leaf
{
  Bounds box;
  std::uint32_t body;  //!< number
};

/** Some leaves of a list. */
struct Leaves
{
  std::vector<Leaf>::iterator first, last;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(last - first); }

  /** The box around all of them. */
  [[nodiscard]] Bounds box() const;

  /** Parts that rays search in little time, at most \a count; sorts the leaves by them. */
  [[nodiscard]] std::vector<Leaves> parts(std::size_t count) const;

  /** Parts of one size, at most \a count, in the order of the list. */
  [[nodiscard]] std::vector<Leaves> equalParts(std::size_t count) const;
};

}  // namespace fastlio
