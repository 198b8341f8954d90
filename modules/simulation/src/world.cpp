// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/simulation/world.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::uint32_t kLeafSize = 2;

/** A ray with what the box test needs. */
struct TracedRay
{
  Vec3 origin, inverse;
};

TracedRay traced(const Ray& ray)
{
  // A zero component would give 0 * inf at a box's border.
  const auto invert = [](double d) { return 1.0 / (std::abs(d) < 1e-200 ? 1e-200 : d); };
  return {ray.origin, ray.direction.unaryExpr(invert)};
}

bool meets(const Bounds& bounds, const TracedRay& ray, double max_range)
{
  const Vec3 a = (bounds.min - ray.origin).cwiseProduct(ray.inverse);
  const Vec3 b = (bounds.max - ray.origin).cwiseProduct(ray.inverse);
  const double enter = a.cwiseMin(b).maxCoeff();
  const double leave = a.cwiseMax(b).minCoeff();
  return enter <= leave && leave >= 0.0 && enter <= max_range;
}

/** Everywhere that a moving object can be. */
Bounds sweptBounds(const MovingObject& object)
{
  const Bounds middle = boundsOf(object.body);
  const Vec3 reach = object.amplitude.cwiseAbs();
  return {middle.min - reach, middle.max + reach};
}

void keepNearer(std::optional<RayHit>& best, const std::optional<RayHit>& hit, double max_range)
{
  if (hit && hit->range <= (best ? best->range : max_range)) best = hit;
}
}  // namespace

Primitive MovingObject::at(double t) const
{
  Primitive moved = body;
  moved.T_world_local.p += amplitude * std::sin(angular_frequency * t + phase);
  return moved;
}

World::World(WorldDescription description) : description_(std::move(description))
{
  for (const auto& object : description_.moving)
    swept_.push_back(sweptBounds(object));
  if (!description_.bodies.empty())
    build(0, static_cast<std::uint32_t>(description_.bodies.size()));
}

std::uint32_t World::build(std::uint32_t first, std::uint32_t last)
{
  auto& bodies = description_.bodies;
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Bounds all, centers;
  for (std::uint32_t i = first; i < last; ++i)
  {
    const Bounds b = boundsOf(bodies[i]);
    all.include(b);
    centers.include({b.center(), b.center()});
  }
  nodes_[index] = {all, first, last - first};
  if (last - first <= kLeafSize) return index;

  int axis = 0;
  (centers.max - centers.min).maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(
      bodies.begin() + first, bodies.begin() + middle, bodies.begin() + last,
      [axis](const Primitive& a, const Primitive& b)
      { return boundsOf(a).center()[axis] < boundsOf(b).center()[axis]; });
  build(first, middle);
  const std::uint32_t right = build(middle, last);
  nodes_[index].first = right;
  nodes_[index].count = 0;
  return index;
}

std::optional<RayHit> World::castBodies(const Ray& ray, double max_range) const
{
  if (nodes_.empty()) return std::nullopt;
  const TracedRay fast = traced(ray);
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 1;
  std::optional<RayHit> best;
  while (depth > 0)
  {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (!meets(node.bounds, fast, best ? best->range : max_range)) continue;
    for (std::uint32_t i = 0; i < node.count; ++i)
      keepNearer(best, intersect(description_.bodies[node.first + i], ray), max_range);
    if (node.count > 0) continue;
    stack[depth++] = node.first;
    stack[depth++] = index + 1;
  }
  return best;
}

std::optional<RayHit> World::cast(const Ray& ray, double t, double max_range) const
{
  std::optional<RayHit> best = castBodies(ray, max_range);
  if (description_.ground)
    keepNearer(best, description_.ground->cast(ray, best ? best->range : max_range), max_range);
  const TracedRay fast = traced(ray);
  for (std::size_t i = 0; i < swept_.size(); ++i)
    if (meets(swept_[i], fast, best ? best->range : max_range))
      keepNearer(best, intersect(description_.moving[i].at(t), ray), max_range);
  return best;
}

}  // namespace fastlio
