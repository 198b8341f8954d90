// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/moving_objects.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kOneScan = 0.5;  // poses farther apart are not of neighbouring scans [s]

/** The rays of a scan: the LiDAR goes straight from its place at the scan before.
 * \param before the IMU at that scan */
ScanRays raysOf(const PlacedScan& scan, const StampedPose& before, const Vec3& lidar_in_imu)
{
  ScanRays rays;
  rays.stamp_ns = scan.result.stamp_ns;
  rays.ends = scan.points;
  const Pose now = scan.result.filter.x.pose();
  const double length = toSeconds(rays.stamp_ns - before.stamp_ns);
  const bool follows = length > 0.0 && length < kOneScan;
  rays.last_origin = now * lidar_in_imu;
  rays.first_origin = follows ? before.T_world_body * lidar_in_imu : rays.last_origin;
  rays.fraction.reserve(rays.ends.size());
  for (const std::int64_t stamp : scan.fields.stamp_ns)
    rays.fraction.push_back(
        follows ? static_cast<float>(toSeconds(stamp - before.stamp_ns) / length) : 1.0F);
  return rays;
}
}  // namespace

std::string removalSentence(const RemovedPoints& counts)
{
  const double all = std::max<double>(1.0, static_cast<double>(counts.points));
  return mrpt::format(
      "moving objects: %zu of %zu points of the scans were removed (%.2f %%), in %zu voxels that "
      "are "
      "free most of the time",
      counts.removed, counts.points, 100.0 * static_cast<double>(counts.removed) / all,
      counts.voxels);
}

void MovingObjects::requireOneLidar(const Session& session)
{
  if (session.selection().further_lidars.empty()) return;
  throw std::invalid_argument(
      "moving objects cannot be removed from '" + session.name() +
      "': it has several LiDARs, and which of them a ray comes from is not known. Leave out "
      "--remove-moving, or choose one LiDAR by input.lidar_sensor_label");
}

MovingObjects::MovingObjects(std::shared_ptr<const Workers> workers, FreeSpaceRule rule)
    : votes_(rule, std::move(workers))
{
}

bool MovingObjects::vote(
    const Session& session, std::size_t number, const BuiltMap& map, const PassHooks& hooks)
{
  requireOneLidar(session);
  PassHooks of_votes = hooks;
  if (hooks.progress)
    of_votes.progress = [&](const std::string&, double share)
    { hooks.progress(session.name() + ": moving objects", share); };
  StampedPose before;
  return placeScans(
      session, number, map.result,
      [&](const PlacedScan& scan)
      {
        if (!hasPose(scan.result.status)) return;
        if (scan.points.size() > 0)
          votes_.add(raysOf(scan, before, map.sessions.at(number).pass.lidar_in_imu));
        before = {scan.result.stamp_ns, scan.result.filter.x.pose()};
      },
      of_votes);
}

void MovingObjects::finish()
{
  votes_.finish();
  counts_.voxels = votes_.freeVoxels();
}

PlacedScan MovingObjects::withoutMoving(const PlacedScan& scan)
{
  const WorldPoints& all = scan.points;
  kept_points_ = all;
  kept_fields_ = scan.fields;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (votes_.isFree(all.x[i], all.y[i], all.z[i])) continue;
    kept_points_.x[kept] = all.x[i];
    kept_points_.y[kept] = all.y[i];
    kept_points_.z[kept] = all.z[i];
    kept_fields_.intensity[kept] = scan.fields.intensity[i];
    kept_fields_.stamp_ns[kept] = scan.fields.stamp_ns[i];
    ++kept;
  }
  counts_.points += all.size();
  counts_.removed += all.size() - kept;
  kept_points_.resize(kept);
  kept_fields_.intensity.resize(kept);
  kept_fields_.stamp_ns.resize(kept);
  return {scan.result, kept_points_, kept_fields_, scan.sensor_origin};
}

}  // namespace fastlio
