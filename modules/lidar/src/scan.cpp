// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/scan.h>

#include <algorithm>

namespace fastlio
{
namespace
{
template <typename Use>
void forEachColumn(PointColumns& points, const Use& use)
{
  use(points.x);
  use(points.y);
  use(points.z);
  use(points.intensity);
  use(points.time_offset_ns);
  use(points.ring);
}
}  // namespace

void PointColumns::clear()
{
  forEachColumn(*this, [](auto& column) { column.clear(); });
}

void PointColumns::reserve(std::size_t n)
{
  forEachColumn(*this, [n](auto& column) { column.reserve(n); });
}

void PointColumns::resize(std::size_t n)
{
  forEachColumn(*this, [n](auto& column) { column.resize(n); });
}

void PointColumns::copy(std::size_t from, std::size_t to)
{
  forEachColumn(*this, [from, to](auto& column) { column[to] = column[from]; });
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
