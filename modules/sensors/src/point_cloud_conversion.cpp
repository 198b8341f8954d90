// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/sweep_time.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/point_cloud_conversion.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace fastlio;

// Turns the time field into seconds after the stamp. Not-a-number does not decide: single points
// without a time are dropped later.
PointTimes readTimes(CloudColumns& cloud, std::int64_t stamp_ns, const CloudTiming& timing)
{
  if (cloud.time.empty() || !timing.reading) return PointTimes::Absent;
  toSecondsAfterStamp(cloud.time, stamp_ns, *timing.reading);
  const bool any_far = std::any_of(
      cloud.time.begin(), cloud.time.end(), [](double t) { return std::abs(t) > kMaxTimeOffset; });
  return any_far ? PointTimes::Unusable : PointTimes::PerPoint;
}

bool isUsable(const CloudColumns& cloud, std::size_t i)
{
  const float x = cloud.x[i], y = cloud.y[i], z = cloud.z[i];
  const bool at_origin = x == 0 && y == 0 && z == 0;
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && !at_origin;
}

void copyUsablePoints(const CloudColumns& cloud, CloudConversion& result)
{
  const bool timed = result.times == PointTimes::PerPoint;
  result.points.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double time_s = timed ? cloud.time[i] : 0.0;
    if (!isUsable(cloud, i) || !std::isfinite(time_s))
    {
      ++result.dropped_invalid;
      continue;
    }
    result.points.push_back(
        cloud.x[i], cloud.y[i], cloud.z[i], cloud.intensity.empty() ? 0.0F : cloud.intensity[i],
        static_cast<std::int32_t>(toNanoseconds(time_s)),
        cloud.ring.empty() ? std::uint16_t{0} : cloud.ring[i]);
  }
}
}  // namespace

namespace fastlio
{
void assignSweepTimes(PointColumns& points, const SweepTiming& sweep)
{
  const double start = sweep.start_azimuth.value_or(startAzimuthOf(points, sweep.sense));
  assignSweepTimes(points, sweep.sense, start, sweep.period, sweep.reference);
}

CloudConversion toTimedPoints(CloudColumns cloud, std::int64_t stamp_ns, const CloudTiming& timing)
{
  CloudConversion result;
  result.times = readTimes(cloud, stamp_ns, timing);
  copyUsablePoints(cloud, result);
  if (result.times != PointTimes::PerPoint && timing.sweep)
  {
    assignSweepTimes(result.points, *timing.sweep);
    result.times = PointTimes::Synthetic;
  }
  return result;
}

}  // namespace fastlio
