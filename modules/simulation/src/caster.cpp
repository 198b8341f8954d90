// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "caster.h"

#include <fastlio/math/time.h>

#include <algorithm>
#include <limits>

namespace fastlio
{
Caster::Caster(const Simulation& simulation)
    : simulation_(&simulation),
      beam_(simulation.settings().lidar.beam),
      panes_(simulation.settings().surface),
      near_(simulation.settings().carrier)
{
}

Caster::Instant Caster::instantOf(double t) const
{
  const Pose T_world_imu = simulation_->motion().pose(t);
  return {t, T_world_imu * simulation_->lidarErrors().T_imu_lidar, near_.at(t, T_world_imu)};
}

std::vector<Echo> Caster::cast(const Sweep& sweep) const
{
  const auto stride = static_cast<std::uint32_t>(simulation_->settings().lidar.stride);
  const double sweep_time = simulation_->secondsSinceStart(sweep.stamp_ns);
  std::vector<Echo> echoes(sweep.shots.size());
  std::int64_t posed_at = std::numeric_limits<std::int64_t>::min();
  Instant instant;
  for (std::size_t i = 0; i < sweep.shots.size(); ++i)
  {
    const Shot& shot = sweep.shots[i];
    if (shot.column % stride != 0) continue;
    // Shots that fire together share the pose.
    if (shot.offset_ns != posed_at)
    {
      posed_at = shot.offset_ns;
      instant = instantOf(sweep_time + static_cast<double>(shot.offset_ns) / kNsPerSecond);
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
  const FirstHit first_hit = [&](const Ray& ray, double max_range)
  { return firstHit(ray, at, max_range); };
  const Look look = [&](const Ray& ray) { return panes_.follow(ray, lidar.max_range, first_hit); };
  const auto back = beam_.receive({T.p, T.R * trueDirection(shot, errors)}, T.R.col(2), look);
  if (!back || back->range < lidar.min_range) return {};
  const double range = back->range + errors.range_offset[shot.ring] + rangeBias(lidar.beam, *back);
  return {std::max(range, 0.0), static_cast<float>(255.0 * back->reflectivity * back->facing)};
}

std::optional<RayHit> Caster::firstHit(const Ray& ray, const Instant& at, double max_range) const
{
  auto nearest = simulation_->world().cast(ray, at.t, max_range);
  for (const Primitive& person : at.people)
  {
    const auto hit = intersect(person, ray);
    if (hit && hit->range <= (nearest ? nearest->range : max_range)) nearest = hit;
  }
  return nearest;
}

}  // namespace fastlio
