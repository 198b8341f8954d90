// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/range_unit.h>
#include <fastlio/math/statistics.h>

#include <cmath>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kFewestUnitPoints = 100;
// No LiDAR that is used for odometry sees half of its points beyond; a room in millimetres is.
constexpr double kLargestMedian = 1000.0;  // [m]
constexpr float kMetresPerMillimetre = 1e-3F;

/** Of the points that are one: finite and not at the origin. */
std::vector<double> rangesOf(const PointColumns& points)
{
  std::vector<double> ranges;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double range = std::hypot(
        static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
        static_cast<double>(points.z[i]));
    if (std::isfinite(range) && range > 0.0) ranges.push_back(range);
  }
  return ranges;
}
}  // namespace

std::optional<double> RangeUnit::bringToMetres(PointColumns& points)
{
  std::optional<double> found;
  if (!decided_)
  {
    std::vector<double> ranges = rangesOf(points);
    if (ranges.size() < kFewestUnitPoints) return std::nullopt;
    const double middle = median(std::move(ranges));
    decided_ = true;
    millimetres_ = middle > kLargestMedian;
    if (millimetres_) found = middle;
  }
  if (!millimetres_) return found;
  for (auto* column : {&points.x, &points.y, &points.z})
    for (float& value : *column)
      value *= kMetresPerMillimetre;
  return found;
}

}  // namespace fastlio
