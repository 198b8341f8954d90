// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "side_by_side.h"
#include "traced_bundle.h"
#include <fastlio/worlds/world.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace fastlio
{
namespace
{
/** Everywhere that a moving object can be. */
Bounds sweptBounds(const MovingObject& object)
{
  const Bounds middle = boundsOf(object.body);
  const Vec3 reach = object.amplitude.cwiseAbs();
  return {middle.min - reach, middle.max + reach};
}

/** meet(i) for each box of the list that the rays can reach. */
template <typename Meet>
void forEachOnTheWay(const BoxList& list, const TracedBundle& rays, const Meet& meet)
{
  for (std::size_t four = 0; four < list.fours().size(); ++four)
  {
    const auto [enter, leave] = rays.through(list.fours()[four]);
    for (std::size_t slot = 0; slot < FourBoxes::kCount; ++slot)
      if (enter[static_cast<Eigen::Index>(slot)] <= leave[static_cast<Eigen::Index>(slot)])
        meet(four * FourBoxes::kCount + slot);
  }
}
}  // namespace

Vec3 MovingObject::positionAt(double t) const
{
  return body.T_world_local.p + amplitude * std::sin(angular_frequency * t + phase);
}

Primitive MovingObject::at(double t) const
{
  Primitive moved = body;
  moved.T_world_local.p = positionAt(t);
  return moved;
}

World::World(WorldDescription description) : description_(std::move(description))
{
  sortSideBySide(description_.bodies);
  tree_ = BoxTree(description_.bodies);
  for (const MovingObject& object : description_.moving)
    swept_.add(sweptBounds(object));
}

void World::trace(TracedBundle& rays, double t, const BoxedBodies& near) const
{
  constexpr auto kInFront = std::numeric_limits<std::uint32_t>::max();
  tree_.cast(description_.bodies, rays);
  if (description_.ground) rays.meet(*description_.ground);
  const auto meet_moving = [&](std::size_t i)
  {
    const MovingObject& object = description_.moving[i];
    rays.meet(object.body, object.positionAt(t), kInFront);
  };
  forEachOnTheWay(swept_, rays, meet_moving);
  const auto meet_near = [&](std::size_t i) { rays.meet(near.bodies()[i], kInFront); };
  forEachOnTheWay(near.boxes(), rays, meet_near);
}

BundleHits World::cast(
    const RayBundle& rays, double t, double max_range, const BoxedBodies& near) const
{
  BundleHits hits;
  if (rays.isOfOneOctant())
  {
    TracedBundle traced(rays, max_range);
    trace(traced, t, near);
    for (std::size_t i = 0; i < rays.count; ++i)
      hits[i] = traced.hit(i);
  }
  else
  {
    for (std::size_t i = 0; i < rays.count; ++i)
      hits[i] = cast(rays.ray(i), t, max_range, near);
  }
  return hits;
}

std::optional<RayHit> World::cast(
    const Ray& ray, double t, double max_range, const BoxedBodies& near) const
{
  const RayBundle alone(ray);
  TracedBundle traced(alone, max_range);
  trace(traced, t, near);
  return traced.hit(0);
}

}  // namespace fastlio
