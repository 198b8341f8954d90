// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "caster.h"

#include "near_bodies.h"
#include <fastlio/math/time.h>
#include <fastlio/worlds/sampled_motion.h>

#include <algorithm>
#include <limits>

namespace fastlio
{
Caster::Caster(const Simulation& simulation)
    : simulation_(&simulation),
      beam_(simulation.settings().lidar.beam),
      panes_(simulation.settings().surface)
{
}

Caster::Instant Caster::instantOf(double t, const Pose& T_world_imu) const
{
  return {
      t, T_world_imu * simulation_->lidarErrors().T_imu_lidar,
      nearBodies(simulation_->settings().carrier, t, T_world_imu)};
}

std::vector<Echo> Caster::cast(const Sweep& sweep) const
{
  const auto stride = static_cast<std::uint32_t>(simulation_->settings().lidar.stride);
  const double sweep_time = simulation_->secondsSinceStart(sweep.stamp_ns);
  std::vector<Echo> echoes(sweep.shots.size());
  std::int64_t posed_at = std::numeric_limits<std::int64_t>::min();
  SampledMotion motion(simulation_->motion());
  Instant instant;
  for (std::size_t i = 0; i < sweep.shots.size(); ++i)
  {
    const Shot& shot = sweep.shots[i];
    if (shot.column % stride != 0) continue;
    // Shots that fire together share the pose.
    if (shot.offset_ns != posed_at)
    {
      posed_at = shot.offset_ns;
      const double t = sweep_time + static_cast<double>(shot.offset_ns) / kNsPerSecond;
      instant = instantOf(t, motion.at(t));
    }
    echoes[i] = echo(shot, instant);
  }
  return echoes;
}

Echo Caster::echo(const Shot& shot, const Instant& at) const
{
  const LidarSettings& lidar = simulation_->settings().lidar;
  const LidarErrors& errors = simulation_->lidarErrors();
  const Pose& T = at.T_world_lidar;
  const RayBundle rays = beam_.rays({T.p, T.R * trueDirection(shot, errors)}, T.R.col(2));
  const auto back = beam_.receive(returnsOf(rays, at));
  if (!back || back->range < lidar.min_range) return {};
  const double range = back->range + errors.range_offset[shot.ring] + rangeBias(lidar.beam, *back);
  return {std::max(range, 0.0), static_cast<float>(255.0 * back->reflectivity * back->facing)};
}

BeamReturns Caster::returnsOf(const RayBundle& rays, const Instant& at) const
{
  const double max_range = simulation_->settings().lidar.max_range;
  const FirstHit behind_a_pane = [&](const Ray& ray, double reach)
  { return firstHits(RayBundle(ray), at, reach)[0]; };
  const BundleHits hits = firstHits(rays, at, max_range);
  BeamReturns backs;
  for (std::size_t i = 0; i < rays.count; ++i)
    backs[i] = panes_.follow(rays.ray(i), hits[i], max_range, behind_a_pane);
  return backs;
}

BundleHits Caster::firstHits(const RayBundle& rays, const Instant& at, double max_range) const
{
  BundleHits nearest = simulation_->world().cast(rays, at.t, max_range);
  for (const Primitive& person : at.people)
    for (std::size_t i = 0; i < rays.count; ++i)
    {
      const auto hit = intersect(person, rays.ray(i));
      if (hit && hit->range <= (nearest[i] ? nearest[i]->range : max_range)) nearest[i] = hit;
    }
  return nearest;
}

}  // namespace fastlio
