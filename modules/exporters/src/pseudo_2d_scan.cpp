// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/pseudo_2d_scan.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/columns.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/run/scan_in_world.h>
#include <fastlio/sensors/conversions.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
mrpt::obs::CObservation2DRangeScan::Ptr emptyScan(int ray_count, double max_range)
{
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  const auto rays = static_cast<std::size_t>(ray_count);
  scan->resizeScanAndAssign(rays, static_cast<float>(max_range), false);
  scan->aperture = static_cast<float>(2.0 * kPi * (1.0 - 1.0 / static_cast<double>(rays)));
  scan->maxRange = static_cast<float>(max_range);
  scan->rightToLeft = true;
  return scan;
}

void addRay(mrpt::obs::CObservation2DRangeScan& scan, double x, double y, double max_range)
{
  const double range = std::hypot(x, y);
  if (range <= 0.0 || range > max_range) return;
  const auto rays = static_cast<int>(scan.getScanSize());
  const double first = -0.5 * static_cast<double>(scan.aperture);
  const double ray = (std::atan2(y, x) - first) / (2.0 * kPi) * rays;
  const auto i = static_cast<std::size_t>((static_cast<int>(std::lround(ray)) + rays) % rays);
  if (scan.getScanRangeValidity(i) && scan.getScanRange(i) <= static_cast<float>(range)) return;
  scan.setScanRange(i, static_cast<float>(range));
  scan.setScanRangeValidity(i, true);
}
}  // namespace

mrpt::obs::CObservation2DRangeScan::Ptr pseudo2dScan(
    const LidarScan& scan, const PoseTrack& track, const ExportOptions& options, double max_range)
{
  const auto vehicle = track.at(scan.stamp_ns);
  if (!vehicle || scan.points.size() == 0) return nullptr;
  const auto ground = onGround(vehicle->T_world_body);
  const Vec3 origin = vehicle->T_world_body * mountingOn(track, scan).p;
  const Mat3 R_level_world = expSO3({0.0, 0.0, -ground.phi()});

  auto planar = emptyScan(options.scan_2d_rays, max_range);
  planar->timestamp = toMrptTime(scan.stamp_ns);
  planar->sensorLabel = "pseudo_2d_scan";
  const Vec3 mounting = R_level_world * (origin - Vec3(ground.x(), ground.y(), 0.0));
  planar->sensorPose = mrpt::poses::CPose3D(mounting.x(), mounting.y(), 0.0, 0.0, 0.0, 0.0);
  // From the LiDAR on: a world in coordinates of surveyors is too large for single precision.
  const OutputPoints around = scanInWorld(scan, track, origin);
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    const Vec3 ray = R_level_world * pointAt(around, i);
    if (std::abs(ray.z() - options.scan_2d_height) <= 0.5 * options.scan_2d_thickness)
      addRay(*planar, ray.x(), ray.y(), max_range);
  }
  return planar;
}

}  // namespace fastlio
