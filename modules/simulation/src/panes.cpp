// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/simulation/panes.h>

#include <cmath>
#include <cstdint>

namespace fastlio
{
namespace
{
constexpr int kMostPanes = 6;      // on the way of one ray; then its light is gone
constexpr double kGlare = 0.9986;  // cosine of 3 deg: so near to the normal a pane shines back
constexpr double kPassed = 0.8;    // fraction of light that comes back through a pane, both ways
constexpr double kSkip = 1e-6;     // past a surface that was met [m]

/** std::floor() without a call, for numbers that fit. */
std::int64_t floorOf(double value)
{
  const auto truncated = static_cast<std::int64_t>(value);
  return truncated - (static_cast<double>(truncated) > value ? 1 : 0);
}

/** A fixed number in [0, 1) for a square of 1.5 m. Along the normal the cells are longer and
 * shifted, so that both faces of a thin wall belong to one. */
double chanceOf(const Vec3& point, const Vec3& normal)
{
  const bool faces_x = std::abs(normal.x()) > std::abs(normal.y());
  std::uint64_t hash = faces_x ? 1U : 2U;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const bool along_normal = axis == (faces_x ? 0 : 1);
    const double cell = along_normal ? 3.7 : 1.5;
    const std::int64_t index = floorOf((point[axis] + 0.613) / cell);
    hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29U;
  }
  return static_cast<double>(hash >> 11U) / 9007199254740992.0;
}
}  // namespace

Panes::Surface Panes::surfaceAt(const Vec3& point, const RayHit& hit) const
{
  constexpr double kUpright = 0.2;  // most of the normal's vertical part
  if (settings_.glass + settings_.mirrors == 0.0 || !hit.flat) return Surface::Matt;
  if (std::abs(hit.normal.z()) > kUpright) return Surface::Matt;
  const double chance = chanceOf(point, hit.normal);
  if (chance < settings_.glass) return Surface::Glass;
  return chance < settings_.glass + settings_.mirrors ? Surface::Mirror : Surface::Matt;
}

std::optional<Return> Panes::follow(
    Ray ray, std::optional<RayHit> hit, double max_range, const FirstHit& next) const
{
  double gone = 0.0, light = 1.0;
  for (int panes = 0; hit && panes <= kMostPanes; ++panes)
  {
    const double facing = -hit->normal.dot(ray.direction);
    const Vec3 point = ray.origin + hit->range * ray.direction;
    const Surface surface = surfaceAt(point, *hit);
    const double range = gone + hit->range;
    if (surface == Surface::Matt) return Return{range, facing, light * hit->reflectivity};
    if (facing > kGlare) return Return{range, facing, light};
    if (surface == Surface::Mirror) ray.direction += 2.0 * facing * hit->normal;
    ray.direction.normalize();
    ray.origin = point + kSkip * ray.direction;
    gone = range + kSkip;
    light *= kPassed;
    hit = next(ray, max_range - gone);
  }
  return std::nullopt;
}

}  // namespace fastlio
