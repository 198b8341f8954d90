// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file neighbor_fit.h Common parts of the maps that fit planes and lines to nearest points.
 */
#pragma once

#include <fastlio/math/so3.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace fastlio
{
/** \exception std::invalid_argument the option \a name of a \a map does not hold its rule */
inline void requireOption(
    bool holds, const std::string& map, const char* name, const char* rule, double value)
{
  if (holds) return;
  throw std::invalid_argument(
      map + ": " + name + " must be " + rule + ", but is " + std::to_string(value));
}

/** Checks the options that both maps have. */
template <typename Options>
void requireCommonOptions(const std::string& map, const Options& o)
{
  requireOption(o.min_spacing >= 0.0, map, "min_spacing", "zero or more", o.min_spacing);
  requireOption(o.point_noise > 0.0, map, "point_noise", "above zero", o.point_noise);
}

/** \exception std::invalid_argument points [first, last) or their matches do not exist */
inline void requireMatchRange(
    const std::string& map, std::size_t first, std::size_t last, std::size_t points,
    std::size_t matches)
{
  if (first <= last && last <= points && last <= matches) return;
  throw std::invalid_argument(
      map + "::match: the range [" + std::to_string(first) + ", " + std::to_string(last) +
      ") does not fit " + std::to_string(points) + " points and " + std::to_string(matches) +
      " matches; resize the matches first");
}

/** A query's neighbours, relative to the query so that single precision loses nothing. */
struct LocalPoints
{
  std::array<Vec3, kMaxNeighbors> items;
  std::size_t count = 0;

  [[nodiscard]] const Vec3* begin() const { return items.data(); }
  [[nodiscard]] const Vec3* end() const { return items.data() + count; }
};

inline LocalPoints localPoints(const NeighborSet& neighbors, float x, float y, float z)
{
  LocalPoints local;
  for (const Neighbor& n : neighbors)
    local.items[local.count++] = {
        static_cast<double>(n.x) - x, static_cast<double>(n.y) - y, static_cast<double>(n.z) - z};
  return local;
}

/** Weighted mean of the prior variance of a point and of the squared residuals of a fit. */
[[nodiscard]] inline double pointVariance(
    double squared_residuals, double degrees_of_freedom, double point_noise)
{
  // Observations that the prior counts for: without it, five neighbours now and then agree
  // perfectly.
  constexpr double kPriorWeight = 4.0;
  return (kPriorWeight * point_noise * point_noise + squared_residuals) /
         (kPriorWeight + degrees_of_freedom);
}

/** Removes what is outside of the radius [m], unless the centre has hardly moved since the last
 * time, as each removal indexes the map anew. */
inline void removeOutsideNowAndThen(
    CIncrementalPointsMap& map, std::optional<Vec3>& last_center, const Vec3& center, double radius)
{
  constexpr double kStep = 0.1;  // of the radius
  if (last_center && (center - *last_center).norm() <= kStep * radius) return;
  last_center = center;
  map.removeOutside(center.x(), center.y(), center.z(), radius);
}

}  // namespace fastlio
