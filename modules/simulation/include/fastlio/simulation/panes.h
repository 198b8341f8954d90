// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file panes.h Glass and mirrors: squares of flat, upright faces that do not scatter light. */
#pragma once

#include <fastlio/simulation/lidar_errors.h>
#include <fastlio/worlds/primitive.h>

#include <functional>
#include <optional>

namespace fastlio
{
/** The first hit of a ray, with its range from the ray's origin. */
using FirstHit = std::function<std::optional<RayHit>(const Ray&, double max_range)>;

/** Follows light through glass and off mirrors. Which squares of a world are panes depends on their
 * place only. */
class Panes
{
 public:
  explicit Panes(const SurfaceSettings& settings) : settings_(settings) {}

  /** The surface from which light comes back to the ray's origin; range along the way of light.
   * \param hit the first hit of the ray \param next finds those after panes */
  [[nodiscard]] std::optional<Return> follow(
      Ray ray, std::optional<RayHit> hit, double max_range, const FirstHit& next) const;

 private:
  enum class Surface
  {
    Matt,
    Glass,
    Mirror
  };
  [[nodiscard]] Surface surfaceAt(const Vec3& point, const RayHit& hit) const;

  SurfaceSettings settings_;
};

}  // namespace fastlio
