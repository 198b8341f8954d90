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
  constexpr double kLeast = 1e-200;
  return 1.0 / (d < 0.0 ? std::min(d, -kLeast) : std::max(d, kLeast));
}
}  // namespace

TracedBundle::TracedBundle(const RayBundle& rays, double max_range) : rays_(rays), reach_(max_range)
{
  free_.fill(max_range);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto component = static_cast<Eigen::Index>(axis);
    const double first = inverseOf(rays.directions[0][component]);
    axes_[axis] = {rays.origin[component], first, first, first < 0.0 ? 1U : 0U};
    for (std::size_t i = 1; i < rays.count; ++i)
    {
      const double inverse = inverseOf(rays.directions[i][component]);
      axes_[axis].least = std::min(axes_[axis].least, inverse);
      axes_[axis].greatest = std::max(axes_[axis].greatest, inverse);
    }
  }
}

TracedBundle::Spans TracedBundle::through(const FourBoxes& boxes) const
{
  using Numbers = FourBoxes::Numbers;
  Spans spans{Numbers::Zero(), Numbers::Constant(reach_)};
  for (std::size_t i = 0; i < axes_.size(); ++i)
  {
    const Axis& axis = axes_[i];
    const Numbers near = boxes.sides(i, axis.near) - axis.origin;
    const Numbers far = boxes.sides(i, 1 - axis.near) - axis.origin;
    spans.enter = spans.enter.max((near * axis.least).min(near * axis.greatest));
    spans.leave = spans.leave.min((far * axis.least).max(far * axis.greatest));
  }
  return spans;
}

void TracedBundle::stop(std::size_t ray, double range)
{
  free_[ray] = range;
  reach_ =
      *std::max_element(free_.begin(), free_.begin() + static_cast<std::ptrdiff_t>(rays_.count));
}

void TracedBundle::meet(const Primitive& body, std::uint32_t number)
{
  const Mat3& R = body.T_world_local.R;
  const Vec3 origin = R.transpose() * (rays_.origin - body.T_world_local.p);
  for (std::size_t i = 0; i < rays_.count; ++i)
  {
    const Ray local{origin, R.transpose() * rays_.directions[i]};
    const BodyHit hit = intersectLocal(body, local);
    if (!std::isfinite(hit.range) || hit.range > free_[i]) continue;
    if (hits_[i] && hit.range == free_[i] && number < number_[i]) continue;
    hits_[i] = worldHit(body, hit, local.direction);
    number_[i] = number;
    stop(i, hit.range);
  }
}

void TracedBundle::meet(const HeightField& ground)
{
  for (std::size_t i = 0; i < rays_.count; ++i)
  {
    const auto hit = ground.cast(rays_.ray(i), free_[i]);
    if (!hit || hit->range > free_[i]) continue;
    hits_[i] = hit;
    stop(i, hit->range);
  }
}

}  // namespace fastlio
