// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/worlds/world.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::uint32_t kLeafSize = 2;
constexpr double kMissed = std::numeric_limits<double>::infinity();

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

/** Where a ray enters a box [m], infinite where it misses the box within its range. */
double entryInto(const Bounds& bounds, const TracedRay& ray, double max_range)
{
  const Vec3 a = (bounds.min - ray.origin).cwiseProduct(ray.inverse);
  const Vec3 b = (bounds.max - ray.origin).cwiseProduct(ray.inverse);
  const double enter = a.cwiseMin(b).maxCoeff();
  const double leave = a.cwiseMax(b).minCoeff();
  return enter <= leave && leave >= 0.0 && enter <= max_range ? enter : kMissed;
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
  struct Visit
  {
    std::uint32_t node;
    double enter;
  };
  const TracedRay fast = traced(ray);
  std::array<Visit, 64> stack{};
  std::size_t depth = 0;
  std::optional<RayHit> best;
  std::uint32_t best_body = 0;
  const auto reach = [&] { return best ? best->range : max_range; };
  const auto push = [&](const Visit& visit)
  {
    if (visit.enter < kMissed) stack[depth++] = visit;
  };
  push({0, entryInto(nodes_[0].bounds, fast, max_range)});
  while (depth > 0)
  {
    const auto [index, enter] = stack[--depth];
    if (enter > reach()) continue;
    const Node& node = nodes_[index];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    {
      const auto hit = intersect(description_.bodies[i], ray);
      if (!hit || hit->range > reach()) continue;
      // Of two bodies that touch, the last counts, in whatever order they are visited.
      if (best && hit->range == best->range && i < best_body) continue;
      best = hit;
      best_body = i;
    }
    if (node.count > 0) continue;
    // The nearer child first: what it stops need not be looked for in the other.
    Visit nearer{index + 1, entryInto(nodes_[index + 1].bounds, fast, reach())};
    Visit farther{node.first, entryInto(nodes_[node.first].bounds, fast, reach())};
    if (farther.enter < nearer.enter) std::swap(nearer, farther);
    push(farther);
    push(nearer);
  }
  return best;
}

std::optional<RayHit> World::cast(const Ray& ray, double t, double max_range) const
{
  std::optional<RayHit> best = castBodies(ray, max_range);
  if (description_.ground)
    keepNearer(best, description_.ground->cast(ray, best ? best->range : max_range), max_range);
  if (swept_.empty()) return best;
  const TracedRay fast = traced(ray);
  for (std::size_t i = 0; i < swept_.size(); ++i)
    if (entryInto(swept_[i], fast, best ? best->range : max_range) < kMissed)
      keepNearer(best, intersect(description_.moving[i].at(t), ray), max_range);
  return best;
}

}  // namespace fastlio
