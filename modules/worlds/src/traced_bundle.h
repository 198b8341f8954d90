// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file traced_bundle.h How far each ray of a bundle is free, as far as is known (internal). */
#pragma once

#include <fastlio/worlds/four_boxes.h>
#include <fastlio/worlds/height_field.h>
#include <fastlio/worlds/ray_bundle.h>

#include <array>
#include <cstdint>

namespace fastlio
{
/** A bundle of rays on their way through a world. */
class TracedBundle
{
 public:
  /** \param rays of one octant, see RayBundle::isOfOneOctant() */
  TracedBundle(const RayBundle& rays, double max_range);

  /** A part of the rays' way for each of four boxes [m]: not more than up to reach(); empty where
   * enter is greater than leave. */
  struct Spans
  {
    FourBoxes::Numbers enter, leave;
  };

  /** Where a ray of the bundle can be inside of the boxes. */
  [[nodiscard]] Spans through(const FourBoxes& boxes) const;

  /** Range [m] that the ray which is free the farthest has. */
  [[nodiscard]] double reach() const { return reach_; }

  /** The rays meet a body, if it is not behind another one. Of two bodies that touch, that of the
   * higher number counts, in whatever order they come. */
  void meet(const Primitive& body, std::uint32_t number);

  /** The rays meet the ground, if it is not behind a body. */
  void meet(const HeightField& ground);

  [[nodiscard]] const BundleHits& hits() const { return hits_; }

 private:
  /** What the rays have in common along an axis. */
  struct Axis
  {
    double origin;
    double least, greatest;  // 1 / direction, of all rays
    std::size_t near;        // side of a box that is met first: 0 or 1
  };

  /** The ray is free up to range [m] only. */
  void stop(std::size_t ray, double range);

  const RayBundle& rays_;
  std::array<Axis, 3> axes_;
  std::array<double, RayBundle::kMost> free_;  // [m]
  double reach_;                               // the greatest of them
  BundleHits hits_;
  std::array<std::uint32_t, RayBundle::kMost> number_{};  // of the body that is hit
};

}  // namespace fastlio
