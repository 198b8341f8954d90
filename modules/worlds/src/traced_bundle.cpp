// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "traced_bundle.h"

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** A zero component would give 0 * inf at a box's border. */
double inverseOf(double d)
{
  return 1.0 / (std::abs(d) < 1e-200 ? 1e-200 : d);
}
}  // namespace

TracedBundle::TracedBundle(const RayBundle& rays, double max_range)
    : rays_(rays), pair_count_((rays.count + 1) / 2)
{
  for (std::size_t i = 0; i < rays.count; ++i)
    reachOf(i) = max_range;
  for (std::size_t i = 0; i < 2 * pair_count_; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Vec3& direction = rays.directions[i < rays.count ? i : 0];
      pairs_[i / 2].inverse[axis][static_cast<Eigen::Index>(i % 2)] =
          inverseOf(direction[static_cast<Eigen::Index>(axis)]);
    }
}

double TracedBundle::entryInto(const Bounds& bounds) const
{
  const Vec3 low = bounds.min - rays_.origin;
  const Vec3 high = bounds.max - rays_.origin;
  double first = kMissed;
  for (std::size_t i = 0; i < pair_count_; ++i)
  {
    const auto& [inverse, reach] = pairs_[i];
    Eigen::Array2d enter = Eigen::Array2d::Constant(-kMissed);
    Eigen::Array2d leave = reach;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const Eigen::Array2d a = low[axis] * inverse[static_cast<std::size_t>(axis)];
      const Eigen::Array2d b = high[axis] * inverse[static_cast<std::size_t>(axis)];
      enter = enter.max(a.min(b));
      leave = leave.min(a.max(b));
    }
    const bool hit = (leave - enter.max(0.0)).maxCoeff() >= 0.0;
    if (hit) first = std::min(first, enter.minCoeff());
  }
  return first;
}

double TracedBundle::reach() const
{
  double farthest = 0.0;
  for (std::size_t i = 0; i < pair_count_; ++i)
    farthest = std::max(farthest, pairs_[i].reach.maxCoeff());
  return farthest;
}

void TracedBundle::meet(const Primitive& body, std::uint32_t number)
{
  const Mat3& R = body.T_world_local.R;
  const Vec3 origin = R.transpose() * (rays_.origin - body.T_world_local.p);
  for (std::size_t i = 0; i < rays_.count; ++i)
  {
    const Ray local{origin, R.transpose() * rays_.directions[i]};
    const BodyHit hit = intersectLocal(body, local);
    double& reach = reachOf(i);
    if (!(hit.range < kMissed && hit.range <= reach)) continue;
    if (hits_[i] && hit.range == reach && number < number_[i]) continue;
    hits_[i] = worldHit(body, hit, local.direction);
    number_[i] = number;
    reach = hit.range;
  }
}

void TracedBundle::meet(const HeightField& ground)
{
  for (std::size_t i = 0; i < rays_.count; ++i)
  {
    double& reach = reachOf(i);
    const auto hit = ground.cast(rays_.ray(i), reach);
    if (!hit || hit->range > reach) continue;
    hits_[i] = hit;
    reach = hit->range;
  }
}

}  // namespace fastlio
