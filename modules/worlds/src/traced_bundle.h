// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file traced_bundle.h How far each ray of a bundle is free, as far as is known (internal). */
#pragma once

#include <fastlio/worlds/height_field.h>
#include <fastlio/worlds/ray_bundle.h>

#include <cstdint>
#include <limits>

namespace fastlio
{
/** A bundle of rays on their way through a world. */
class TracedBundle
{
 public:
  TracedBundle(const RayBundle& rays, double max_range);

  static constexpr double kMissed = std::numeric_limits<double>::infinity();

  /** Where the rays enter a box, or earlier [m]; infinite where all of them miss it. */
  [[nodiscard]] double entryInto(const Bounds& bounds) const;

  /** Range [m] that the ray which is free the farthest has. */
  [[nodiscard]] double reach() const;

  /** The rays meet a body, if it is not behind another one. Of two bodies that touch, that of the
   * higher number counts, in whatever order they come. */
  void meet(const Primitive& body, std::uint32_t number);

  /** The rays meet the ground, if it is not behind a body. */
  void meet(const HeightField& ground);

  [[nodiscard]] const BundleHits& hits() const { return hits_; }

 private:
  /** Two rays side by side, as a register takes them. */
  struct Pair
  {
    std::array<Eigen::Array2d, 3> inverse;  // of the directions, by axis
    Eigen::Array2d reach{-1.0, -1.0};       // [m]; below zero: no ray
  };

  [[nodiscard]] double& reachOf(std::size_t ray)
  {
    return pairs_[ray / 2].reach[static_cast<Eigen::Index>(ray % 2)];
  }

  const RayBundle& rays_;
  std::array<Pair, RayBundle::kMost / 2> pairs_;
  std::size_t pair_count_;
  BundleHits hits_;
  std::array<std::uint32_t, RayBundle::kMost> number_{};  // of the body that is hit
};

}  // namespace fastlio
