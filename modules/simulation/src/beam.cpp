// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/simulation/beam.h>

#include <Eigen/Geometry>

#include <array>

namespace fastlio
{
namespace
{
struct Part
{
  Return back;
  double light = 0.0;
};

/** The parts of a beam that came back, the nearest first. */
struct Parts
{
  std::array<Part, 5> part;
  std::size_t count = 0;

  void add(const std::optional<Return>& back)
  {
    if (!back || back->range <= 0.0) return;
    const double light = back->reflectivity * back->facing / (back->range * back->range);
    std::size_t place = count++;
    for (; place > 0 && part[place - 1].back.range > back->range; --place)
      part[place] = part[place - 1];
    part[place] = {*back, light};
  }
};

/** Mean of the parts first..last, by light. */
Part merged(const Parts& parts, std::size_t first, std::size_t last)
{
  Part sum{{0.0, 0.0, 0.0}, 0.0};
  for (std::size_t i = first; i < last; ++i)
  {
    const auto& [back, light] = parts.part[i];
    sum.light += light;
    sum.back.range += light * back.range;
    sum.back.facing += light * back.facing;
    sum.back.reflectivity += light * back.reflectivity;
  }
  sum.back.range /= sum.light;
  sum.back.facing /= sum.light;
  sum.back.reflectivity /= sum.light;
  return sum;
}

std::optional<Return> strongest(const Parts& parts)
{
  std::optional<Part> best;
  for (std::size_t first = 0, last = 0; first < parts.count; first = last)
  {
    const double reach = parts.part[first].back.range + Beam::kPulseLength;
    while (last < parts.count && parts.part[last].back.range < reach)
      ++last;
    const Part group = merged(parts, first, last);
    if (group.light > 0.0 && (!best || group.light > best->light)) best = group;
  }
  if (!best) return std::nullopt;
  return best->back;
}
}  // namespace

Beam::Beam(const BeamSettings& settings)
    : half_width_(0.5 * settings.divergence_horizontal),
      half_height_(0.5 * settings.divergence_vertical)
{
}

RayBundle Beam::rays(const Ray& middle, const Vec3& up) const
{
  RayBundle rays(middle);
  if (hasNoWidth()) return rays;
  // Five rays of equal light: the middle, and the middle of each quarter, a little farther out.
  constexpr double kOuter = 0.6;
  const Vec3& d = middle.direction;
  const Vec3 aside = half_width_ * kOuter * up.cross(d).normalized();
  const Vec3 upward = half_height_ * kOuter * d.cross(up.cross(d)).normalized();
  using Four = Eigen::Array4d;
  const Four sideways(-1.0, -1.0, 1.0, 1.0), upwards(-1.0, 1.0, -1.0, 1.0);
  const auto along = [&](Eigen::Index axis) -> Four
  { return d[axis] + sideways * aside[axis] + upwards * upward[axis]; };
  const Four x = along(0), y = along(1), z = along(2);
  const Four length = (x * x + y * y + z * z).sqrt();
  const Four unit_x = x / length, unit_y = y / length, unit_z = z / length;
  for (Eigen::Index i = 0; i < 4; ++i)
    rays.directions[rays.count++] = {unit_x[i], unit_y[i], unit_z[i]};
  return rays;
}

std::optional<Return> Beam::receive(const BeamReturns& backs) const
{
  if (hasNoWidth()) return backs[0];
  Parts parts;
  for (const auto& back : backs)
    parts.add(back);
  return strongest(parts);
}

}  // namespace fastlio
