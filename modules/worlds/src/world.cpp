// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

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

World::World(WorldDescription description)
    : description_(std::move(description)), tree_(description_.bodies)
{
  const auto& moving = description_.moving;
  swept_.resize((moving.size() + FourBoxes::kCount - 1) / FourBoxes::kCount);
  for (std::size_t i = 0; i < moving.size(); ++i)
    swept_[i / FourBoxes::kCount].set(i % FourBoxes::kCount, sweptBounds(moving[i]));
}

void World::castMoving(TracedBundle& rays, double t) const
{
  constexpr auto kInFront = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t four = 0; four < swept_.size(); ++four)
  {
    const auto [enter, leave] = rays.through(swept_[four]);
    for (std::size_t slot = 0; slot < FourBoxes::kCount; ++slot)
      if (enter[static_cast<Eigen::Index>(slot)] <= leave[static_cast<Eigen::Index>(slot)])
      {
        const MovingObject& object = description_.moving[four * FourBoxes::kCount + slot];
        rays.meet(object.body, object.positionAt(t), kInFront);
      }
  }
}

BundleHits World::cast(const RayBundle& rays, double t, double max_range) const
{
  BundleHits hits;
  if (!rays.isOfOneOctant())
  {
    for (std::size_t i = 0; i < rays.count; ++i)
      hits[i] = cast(rays.ray(i), t, max_range);
    return hits;
  }
  TracedBundle traced(rays, max_range);
  tree_.cast(description_.bodies, traced);
  if (description_.ground) traced.meet(*description_.ground);
  castMoving(traced, t);
  return traced.hits();
}

std::optional<RayHit> World::cast(const Ray& ray, double t, double max_range) const
{
  return cast(RayBundle(ray), t, max_range)[0];
}

}  // namespace fastlio
