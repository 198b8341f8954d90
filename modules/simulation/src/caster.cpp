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

void Caster::moveTo(Instant& instant, double t, const Pose& T_world_imu) const
{
  instant.t = t;
  instant.T_world_lidar = T_world_imu * simulation_->lidarErrors().T_imu_lidar;
  placeNearBodies(instant.people, simulation_->settings().carrier, t, T_world_imu);
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
      moveTo(instant, t, motion.at(t));
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
  const auto back = returnOf(rays, at);
  if (!back || back->range < lidar.min_range) return {};
  const double range = back->range + errors.range_offset[shot.ring] + rangeBias(lidar.beam, *back);
  return {std::max(range, 0.0), static_cast<float>(255.0 * back->reflectivity * back->facing)};
}

std::optional<Return> Caster::returnOf(const RayBundle& rays, const Instant& at) const
{
  const World& world = simulation_->world();
  const double max_range = simulation_->settings().lidar.max_range;
  const FirstHit first_hit = [&](const Ray& ray, double reach)
  { return world.cast(ray, at.t, reach, at.people); };
  if (rays.count == 1)
  {
    const Ray ray = rays.ray(0);
    return panes_.follow(ray, first_hit(ray, max_range), max_range, first_hit);
  }
  const BundleHits hits = world.cast(rays, at.t, max_range, at.people);
  BeamReturns backs;
  for (std::size_t i = 0; i < rays.count; ++i)
    backs[i] = panes_.follow(rays.ray(i), hits[i], max_range, first_hit);
  return beam_.receive(backs);
}

}  // namespace fastlio
