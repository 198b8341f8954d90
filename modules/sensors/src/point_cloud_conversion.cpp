// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/sensors/point_cloud_conversion.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace
{
using namespace fastlio;

// So many of a scan's times may be damaged before none of them is believed.
constexpr double kMostImpossible = 0.05;

// Turns the time field into seconds after the stamp. Not-a-number does not decide: points without
// a time are dropped later, as are single ones of an impossible time.
PointTimes readTimes(CloudColumns& cloud, std::int64_t stamp_ns, const CloudTiming& timing)
{
  if (cloud.time.empty() || !timing.reading) return PointTimes::Absent;
  toSecondsAfterStamp(cloud.time, stamp_ns, *timing.reading);
  const auto impossible = std::count_if(
      cloud.time.begin(), cloud.time.end(), [](double t) { return std::abs(t) > kMaxTimeOffset; });
  const bool many =
      static_cast<double>(impossible) > kMostImpossible * static_cast<double>(cloud.size());
  return many ? PointTimes::Unusable : PointTimes::PerPoint;
}

bool isUsable(const CloudColumns& cloud, std::size_t i)
{
  const float x = cloud.x[i], y = cloud.y[i], z = cloud.z[i];
  const bool at_origin = x == 0 && y == 0 && z == 0;
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && !at_origin;
}

// As toNanoseconds(), which calls llround() for each point.
std::int32_t nanoseconds(double seconds)
{
  const double exact = seconds * kNsPerSecond;
  const auto whole = static_cast<std::int32_t>(exact);
  const double rest = exact - whole;
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

// Moves usable points to the front of the columns, which become those of the result.
void takeUsablePoints(CloudColumns& cloud, CloudConversion& result)
{
  const std::size_t n = cloud.size();
  const bool timed = result.times == PointTimes::PerPoint;
  std::vector<std::int32_t> offsets(n, 0);
  cloud.intensity.resize(n, 0.0F);
  cloud.ring.resize(n, 0);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (!isUsable(cloud, i) || (timed && !(std::abs(cloud.time[i]) <= kMaxTimeOffset))) continue;
    if (timed) offsets[kept] = nanoseconds(cloud.time[i]);
    if (kept != i)
    {
      cloud.x[kept] = cloud.x[i];
      cloud.y[kept] = cloud.y[i];
      cloud.z[kept] = cloud.z[i];
      cloud.intensity[kept] = cloud.intensity[i];
      cloud.ring[kept] = cloud.ring[i];
    }
    ++kept;
  }
  result.dropped_invalid += n - kept;
  for (auto* column : {&cloud.x, &cloud.y, &cloud.z, &cloud.intensity})
    column->resize(kept);
  cloud.ring.resize(kept);
  offsets.resize(kept);
  result.points = {std::move(cloud.x),         std::move(cloud.y), std::move(cloud.z),
                   std::move(cloud.intensity), std::move(offsets), std::move(cloud.ring)};
}
}  // namespace

namespace fastlio
{
CloudConversion toTimedPoints(CloudColumns cloud, std::int64_t stamp_ns, const CloudTiming& timing)
{
  CloudConversion result;
  result.times = readTimes(cloud, stamp_ns, timing);
  takeUsablePoints(cloud, result);
  if (result.times != PointTimes::PerPoint && timing.sweep)
  {
    assignSweepTimes(result.points, *timing.sweep);
    result.times = PointTimes::Synthetic;
  }
  return result;
}

}  // namespace fastlio
