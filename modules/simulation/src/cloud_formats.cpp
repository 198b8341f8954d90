// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_formats.h"

#include <fastlio/math/time.h>
#include <fastlio/recordings/cloud_builder.h>

#include <mrpt/maps/CPointsMapXYZI.h>

#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
mrpt::maps::CPointsMap::Ptr makeXyzi(const PointColumns& points)
{
  auto cloud = mrpt::maps::CPointsMapXYZI::Create();
  cloud->resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    cloud->setPointFast(i, points.x[i], points.y[i], points.z[i]);
    cloud->setPointIntensity(i, points.intensity[i]);
  }
  return cloud;
}

std::int64_t shiftOf(const LidarSettings& lidar)
{
  const double sweep_ns = kNsPerSecond / lidar.rate;
  switch (lidar.time_reference)
  {
    case CloudTimeReference::Middle:
      return std::llround(0.5 * sweep_ns);
    case CloudTimeReference::End:
      return std::llround(sweep_ns);
    case CloudTimeReference::Start:
    case CloudTimeReference::Absolute:
      break;
  }
  return 0;
}
}  // namespace

CloudFormat::CloudFormat(const LidarSettings& lidar)
    : cloud_(lidar.cloud),
      absolute_(lidar.time_reference == CloudTimeReference::Absolute),
      unit_ns_(
          std::array<double, 4>{1e9, 1e6, 1e3, 1.0}.at(static_cast<std::size_t>(lidar.time_unit))),
      shift_ns_(shiftOf(lidar))
{
}

double CloudFormat::timeOf(std::int32_t offset_ns, std::int64_t first_shot_ns) const
{
  const std::int64_t time_ns = absolute_ ? first_shot_ns + offset_ns : offset_ns - shift_ns_;
  return static_cast<double>(time_ns) / unit_ns_;
}

mrpt::maps::CPointsMap::Ptr CloudFormat::encode(
    const PointColumns& points, std::int64_t first_shot_ns) const
{
  if (cloud_ == LidarCloud::Xyzi) return makeXyzi(points);
  CloudColumns columns{points.x, points.y, points.z, points.intensity, points.ring, {}};
  for (const std::int32_t offset_ns : points.time_offset_ns)
    columns.time.push_back(timeOf(offset_ns, first_shot_ns));
  if (cloud_ == LidarCloud::Generic) return makeCloud(columns, {}, 0)->pointcloud;
  return makeXyzirt(columns);
}

}  // namespace fastlio
