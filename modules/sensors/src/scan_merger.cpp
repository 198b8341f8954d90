// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/columns.h>
#include <fastlio/sensors/scan_merger.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
// Lines of different LiDARs are different lines; no sensor has as many.
constexpr std::uint16_t kRingsPerLidar = 256;

// Scans of the first LiDAR wait so long beyond their end: drivers stamp scans at their start or at
// their end.
constexpr std::int64_t kWaitNs = 200'000'000;

// Without scans of the first LiDAR the others must not pile up.
constexpr std::size_t kMostWaiting = 200;

void append(PointColumns& to, const PointColumns& from, std::size_t i, const Pose& T_to_from)
{
  const Vec3 p = T_to_from * pointAt(from, i);
  to.push_back(
      static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
      from.intensity[i], from.time_offset_ns[i], from.ring[i]);
}
}  // namespace

void ScanMerger::add(std::size_t lidar, LidarScan scan)
{
  if (lidar == 0)
    first_.push_back(std::move(scan));
  else
    further_.push_back({lidar, std::move(scan)});
  if (further_.size() <= kMostWaiting) return;
  left_out_ += further_.front().scan.points.size();
  further_.pop_front();
}

std::optional<LidarScan> ScanMerger::next(std::int64_t now_ns)
{
  if (first_.empty() || spanOf(first_.front()).end_ns + kWaitNs > now_ns) return std::nullopt;
  return flush();
}

std::optional<LidarScan> ScanMerger::flush()
{
  if (first_.empty())
  {
    for (const Further& further : std::exchange(further_, {}))
      left_out_ += further.scan.points.size();
    return std::nullopt;
  }
  LidarScan merged = std::move(first_.front());
  first_.pop_front();
  ScanSpan window = spanOf(merged);
  // Between two scans of the first LiDAR there may be a pause, but not as long as a scan.
  window.begin_ns -= (window.end_ns - window.begin_ns) / 2;
  for (Further& further : further_)
    join(merged, window, further);
  const auto used_up = [](const Further& further) { return further.scan.points.size() == 0; };
  further_.erase(std::remove_if(further_.begin(), further_.end(), used_up), further_.end());
  return merged;
}

/** Moves what was measured up to the end of the window out of the further scan. */
void ScanMerger::join(LidarScan& first, const ScanSpan& window, Further& further)
{
  const LidarScan& scan = further.scan;
  const ScanSpan span = spanOf(scan);
  if (scan.points.size() == 0 || span.begin_ns > window.end_ns) return;
  const Pose T_first_further = first.T_imu_lidar.inverse() * scan.T_imu_lidar;
  const std::int64_t shift_ns = scan.stamp_ns - first.stamp_ns;
  PointColumns rest;
  for (std::size_t i = 0; i < scan.points.size(); ++i)
  {
    const std::int64_t time_ns = scan.stamp_ns + scan.points.time_offset_ns[i];
    if (time_ns > window.end_ns)
    {
      append(rest, scan.points, i, Pose{});
      continue;
    }
    if (time_ns < window.begin_ns)
    {
      ++left_out_;
      continue;
    }
    append(first.points, scan.points, i, T_first_further);
    first.points.time_offset_ns.back() += static_cast<std::int32_t>(shift_ns);
    first.points.ring.back() =
        static_cast<std::uint16_t>(first.points.ring.back() + kRingsPerLidar * further.lidar);
  }
  first.has_point_times |= scan.has_point_times;
  further.scan.points = std::move(rest);
}

}  // namespace fastlio
