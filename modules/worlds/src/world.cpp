// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "traced_bundle.h"
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

/** Everywhere that a moving object can be. */
Bounds sweptBounds(const MovingObject& object)
{
  const Bounds middle = boundsOf(object.body);
  const Vec3 reach = object.amplitude.cwiseAbs();
  return {middle.min - reach, middle.max + reach};
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

void World::castBodies(TracedBundle& rays) const
{
  if (nodes_.empty()) return;
  struct Visit
  {
    std::uint32_t node;
    double enter;
  };
  std::array<Visit, 64> stack;
  std::size_t depth = 0;
  const auto push = [&](const Visit& visit)
  {
    if (visit.enter < TracedBundle::kMissed) stack[depth++] = visit;
  };
  push({0, rays.entryInto(nodes_[0].bounds)});
  while (depth > 0)
  {
    const auto [index, enter] = stack[--depth];
    if (enter > rays.reach()) continue;
    const Node& node = nodes_[index];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      rays.meet(description_.bodies[i], i);
    if (node.count > 0) continue;
    // The nearer child first: what it stops need not be looked for in the other.
    Visit nearer{index + 1, rays.entryInto(nodes_[index + 1].bounds)};
    Visit farther{node.first, rays.entryInto(nodes_[node.first].bounds)};
    if (farther.enter < nearer.enter) std::swap(nearer, farther);
    push(farther);
    push(nearer);
  }
}

void World::castMoving(TracedBundle& rays, double t) const
{
  constexpr auto kInFront = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < swept_.size(); ++i)
    if (rays.entryInto(swept_[i]) < TracedBundle::kMissed)
      rays.meet(description_.moving[i].at(t), kInFront);
}

BundleHits World::cast(const RayBundle& rays, double t, double max_range) const
{
  TracedBundle traced(rays, max_range);
  castBodies(traced);
  if (description_.ground) traced.meet(*description_.ground);
  castMoving(traced, t);
  return traced.hits();
}

std::optional<RayHit> World::cast(const Ray& ray, double t, double max_range) const
{
  return cast(RayBundle(ray), t, max_range)[0];
}

}  // namespace fastlio
