// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/scan.h>

#include <algorithm>

namespace fastlio
{
void PointColumns::clear()
{
  x.clear();
  y.clear();
  z.clear();
  intensity.clear();
  time_offset_ns.clear();
  ring.clear();
}

void PointColumns::reserve(std::size_t n)
{
  x.reserve(n);
  y.reserve(n);
  z.reserve(n);
  intensity.reserve(n);
  time_offset_ns.reserve(n);
  ring.reserve(n);
}

void PointColumns::resize(std::size_t n)
{
  x.resize(n);
  y.resize(n);
  z.resize(n);
  intensity.resize(n);
  time_offset_ns.resize(n);
  ring.resize(n);
}

void PointColumns::copy(std::size_t from, std::size_t to)
{
  x[to] = x[from];
  y[to] = y[from];
  z[to] = z[from];
  intensity[to] = intensity[from];
  time_offset_ns[to] = time_offset_ns[from];
  ring[to] = ring[from];
}

void PointColumns::push_back(
    float px, float py, float pz, float point_intensity, std::int32_t offset_ns,
    std::uint16_t point_ring)
{
  x.push_back(px);
  y.push_back(py);
  z.push_back(pz);
  intensity.push_back(point_intensity);
  time_offset_ns.push_back(offset_ns);
  ring.push_back(point_ring);
}

ScanSpan spanOf(const LidarScan& scan)
{
  const auto& offsets = scan.points.time_offset_ns;
  if (offsets.empty()) return {scan.stamp_ns, scan.stamp_ns};
  std::int32_t first = offsets.front(), last = first;
  // Plain comparisons: the compiler vectorises them, unlike std::minmax_element.
  for (const std::int32_t offset : offsets)
  {
    first = std::min(first, offset);
    last = std::max(last, offset);
  }
  return {scan.stamp_ns + first, scan.stamp_ns + last};
}

}  // namespace fastlio
