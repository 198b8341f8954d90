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
    directions_[axis].fill(rays.directions[0][component]);
    const double first = inverseOf(rays.directions[0][component]);
    axes_[axis] = {rays.origin[component], first, first, first < 0.0 ? 1U : 0U};
    for (std::size_t i = 1; i < rays.count; ++i)
    {
      directions_[axis][i] = rays.directions[i][component];
      const double inverse = inverseOf(rays.directions[i][component]);
      axes_[axis].least = std::min(axes_[axis].least, inverse);
      axes_[axis].greatest = std::max(axes_[axis].greatest, inverse);
    }
  }
}

void TracedBundle::meet(const Primitive& body, const Vec3& position, std::uint32_t number)
{
  const bool is_flat = isFlat(body.shape);
  if (is_flat && rays_.count == 1)
    meetFlat<1>(body, position, number);
  else if (is_flat)
    meetFlat<RayBundle::kMost>(body, position, number);
  else
    meetCurved(body, position, number);
}

template <std::size_t N>
void TracedBundle::meetFlat(const Primitive& body, const Vec3& position, std::uint32_t number)
{
  const Mat3& R = body.T_world_local.R;
  const LocalRays<N> local{R.transpose() * (rays_.origin - position), turned<N>(R, directions_)};
  const FaceHits<N> hits = body.shape == Primitive::Shape::Box ? hitBox(local, body.size)
                                                               : hitRectangle(local, body.size);
  bool is_any = false;
  for (std::size_t i = 0; i < std::min(N, rays_.count); ++i)
  {
    if (!isFirst(i, hits.range[i], number)) continue;
    free_[i] = hits.range[i];
    met_[i] = {true, number, &body, Vec3::Unit(static_cast<Eigen::Index>(hits.axis[i])), 0.0};
    is_any = true;
  }
  if (is_any) updateReach();
}

void TracedBundle::meetCurved(const Primitive& body, const Vec3& position, std::uint32_t number)
{
  const Mat3& R = body.T_world_local.R;
  const Vec3 origin = R.transpose() * (rays_.origin - position);
  for (std::size_t i = 0; i < rays_.count; ++i)
  {
    const BodyHit hit = intersectLocal(body, {origin, turned(R, rays_.directions[i])});
    if (!isFirst(i, hit.range, number)) continue;
    free_[i] = hit.range;
    met_[i] = {true, number, &body, hit.normal, 0.0};
  }
  updateReach();
}

void TracedBundle::meet(const HeightField& ground)
{
  for (std::size_t i = 0; i < rays_.count; ++i)
  {
    const auto hit = ground.cast(rays_.ray(i), free_[i]);
    if (!hit || hit->range > free_[i]) continue;
    free_[i] = hit->range;
    met_[i] = {true, 0, nullptr, hit->normal, hit->reflectivity};
  }
  updateReach();
}

void TracedBundle::updateReach()
{
  reach_ = free_[0];
  for (std::size_t i = 1; i < rays_.count; ++i)
    reach_ = std::max(reach_, free_[i]);
}

std::optional<RayHit> TracedBundle::hit(std::size_t ray) const
{
  const Met& met = met_[ray];
  if (!met.is_hit) return std::nullopt;
  if (met.body == nullptr) return RayHit{free_[ray], met.normal, met.ground_reflectivity};
  const Mat3& R = met.body->T_world_local.R;
  return worldHit(*met.body, {free_[ray], met.normal}, turned(R, rays_.directions[ray]));
}

}  // namespace fastlio
