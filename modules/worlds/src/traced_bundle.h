// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file traced_bundle.h How far each ray of a bundle is free, as far as is known (internal). */
#pragma once

#include "flat_faces.h"
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
  [[nodiscard]] Spans through(const FourBoxes& boxes) const
  {
    using Numbers = FourBoxes::Numbers;
    Spans spans{Numbers::Zero(), Numbers::Constant(reach_)};
    for (std::size_t i = 0; i < axes_.size(); ++i)
    {
      const Axis& axis = axes_[i];
      const Numbers near = boxes.sides(i, axis.near) - axis.origin;
      const Numbers far = boxes.sides(i, 1 - axis.near) - axis.origin;
      spans.enter = spans.enter.max((near * axis.least).min(near * axis.greatest));
      spans.leave = spans.leave.min((far * axis.least).max(far * axis.greatest));
    }
    return spans;
  }

  /** Range [m] that the ray which is free the farthest has. */
  [[nodiscard]] double reach() const { return reach_; }

  /** The rays meet a body, if it is not behind another one. Of two bodies that touch, that of the
   * higher number counts, in whatever order they come. The bundle refers to the body. */
  void meet(const Primitive& body, std::uint32_t number)
  {
    meet(body, body.T_world_local.p, number);
  }

  /** The same for a body that has moved to \a position. */
  void meet(const Primitive& body, const Vec3& position, std::uint32_t number);

  /** The rays meet the ground, if it is not behind a body. */
  void meet(const HeightField& ground);

  /** What a ray has met. */
  [[nodiscard]] std::optional<RayHit> hit(std::size_t ray) const;

 private:
  /** What the rays have in common along an axis. */
  struct Axis
  {
    double origin;
    double least, greatest;  // 1 / direction, of all rays
    std::size_t near;        // side of a box that is met first: 0 or 1
  };

  /** What a ray meets first. */
  struct Met
  {
    bool is_hit = false;         // without a hit, nothing else is set
    std::uint32_t number;        // of the body
    const Primitive* body;       // none: it is the ground
    Vec3 normal;                 // in the frame of the body
    double ground_reflectivity;  // where there is no body
  };

  template <std::size_t N>
  void meetFlat(const Primitive& body, const Vec3& position, std::uint32_t number);
  void meetCurved(const Primitive& body, const Vec3& position, std::uint32_t number);

  /** Whether a body is the first on a ray's way, as far as is known. */
  [[nodiscard]] bool isFirst(std::size_t ray, double range, std::uint32_t number) const
  {
    if (!(range <= free_[ray]) || !std::isfinite(range)) return false;
    return range < free_[ray] || !met_[ray].is_hit || number >= met_[ray].number;
  }

  void updateReach();

  const RayBundle& rays_;
  std::array<Lanes<RayBundle::kMost>, 3> directions_;  // x, y and z of the rays
  std::array<Axis, 3> axes_;
  Lanes<RayBundle::kMost> free_;  // [m]
  double reach_;                  // the greatest of them
  std::array<Met, RayBundle::kMost> met_;
};

}  // namespace fastlio
