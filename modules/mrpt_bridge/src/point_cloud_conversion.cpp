// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/point_cloud_conversion.h>

#include <algorithm>
#include <cmath>

namespace
{
using fastlio::CloudColumns;
using fastlio::PointTimes;

constexpr double kNanosecondsPerSecond = 1e9;

// Not-a-number does not decide: single points without a time are dropped later.
PointTimes judgeTimes(const CloudColumns& cloud)
{
  if (cloud.time_s.empty()) return PointTimes::Absent;
  const bool any_far = std::any_of(
      cloud.time_s.begin(), cloud.time_s.end(),
      [](float t) { return std::abs(static_cast<double>(t)) > fastlio::kMaxTimeOffset; });
  return any_far ? PointTimes::Unusable : PointTimes::PerPoint;
}

bool isUsable(const CloudColumns& cloud, std::size_t i)
{
  const float x = cloud.x[i], y = cloud.y[i], z = cloud.z[i];
  const bool at_origin = x == 0 && y == 0 && z == 0;
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && !at_origin;
}
}  // namespace

namespace fastlio
{
CloudConversion toTimedPoints(const CloudColumns& cloud)
{
  CloudConversion result;
  result.times = judgeTimes(cloud);
  const bool timed = result.times == PointTimes::PerPoint;
  result.points.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double time_s = timed ? static_cast<double>(cloud.time_s[i]) : 0.0;
    if (!isUsable(cloud, i) || !std::isfinite(time_s))
    {
      ++result.dropped_invalid;
      continue;
    }
    result.points.push_back(
        cloud.x[i], cloud.y[i], cloud.z[i], cloud.intensity.empty() ? 0.0F : cloud.intensity[i],
        static_cast<std::int32_t>(std::lround(time_s * kNanosecondsPerSecond)),
        cloud.ring.empty() ? std::uint16_t{0} : cloud.ring[i]);
  }
  return result;
}

}  // namespace fastlio
