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

/** Nanoseconds per unit. */
double nanosecondsPer(CloudTimeUnit unit)
{
  return std::array<double, 4>{1e9, 1e6, 1e3, 1.0}.at(static_cast<std::size_t>(unit));
}
}  // namespace

std::int64_t stampShiftOf(const LidarSettings& lidar)
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

mrpt::maps::CPointsMap::Ptr encodeCloud(
    const PointColumns& points, std::int64_t first_shot_ns, const LidarSettings& lidar)
{
  if (lidar.cloud == LidarCloud::Xyzi) return makeXyzi(points);
  const bool absolute = lidar.time_reference == CloudTimeReference::Absolute;
  const std::int64_t zero_ns = absolute ? -first_shot_ns : stampShiftOf(lidar);
  CloudColumns columns{points.x, points.y, points.z, points.intensity, points.ring, {}};
  for (const std::int32_t offset_ns : points.time_offset_ns)
    columns.time.push_back(
        static_cast<double>(offset_ns - zero_ns) / nanosecondsPer(lidar.time_unit));
  if (lidar.cloud == LidarCloud::Generic) return makeCloud(columns, {}, 0)->pointcloud;
  return makeXyzirt(columns);
}

}  // namespace fastlio
