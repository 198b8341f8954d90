// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/columns.h>
#include <fastlio/run/scan_in_world.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Poses of the LiDAR are made once for so much time.
constexpr std::int64_t kStepNs = 1'000'000;

/** The LiDAR's pose through a scan, in steps. */
class SensorPath
{
 public:
  SensorPath(const LidarScan& scan, const PoseTrack& track)
  {
    const Pose T_body_lidar = mountingOn(track, scan);
    const ScanSpan span = spanOf(scan);
    begin_ns_ = span.begin_ns;
    for (std::int64_t stamp = span.begin_ns; stamp <= span.end_ns; stamp += kStepNs)
    {
      const auto pose = track.at(std::min(stamp + kStepNs / 2, span.end_ns));
      steps_.push_back(
          pose ? std::optional<Pose>(pose->T_world_body * T_body_lidar) : std::nullopt);
    }
  }

  [[nodiscard]] const std::optional<Pose>& at(std::int64_t stamp_ns) const
  {
    return steps_.at(static_cast<std::size_t>((stamp_ns - begin_ns_) / kStepNs));
  }

 private:
  std::int64_t begin_ns_ = 0;
  std::vector<std::optional<Pose>> steps_;
};
}  // namespace

Pose mountingOn(const PoseTrack& track, const LidarScan& scan)
{
  return track.frame().T_imu_body.inverse() * scan.T_imu_lidar;
}

OutputPoints scanInWorld(const LidarScan& scan, const PoseTrack& track, const Vec3& origin)
{
  OutputPoints world;
  const SensorPath path(scan, track);
  const PointColumns& points = scan.points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t stamp_ns = scan.stamp_ns + points.time_offset_ns[i];
    const auto& T_world_lidar = path.at(stamp_ns);
    if (!T_world_lidar) continue;
    world.add(*T_world_lidar * pointAt(points, i) - origin);
    world.intensity.push_back(points.intensity[i]);
    world.stamp_ns.push_back(stamp_ns);
  }
  return world;
}

}  // namespace fastlio
