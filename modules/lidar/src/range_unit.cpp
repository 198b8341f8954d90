// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/range_unit.h>
#include <fastlio/math/so3.h>
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
// Hardly one sees half of its points beyond, but for that of a high aircraft: a room in
// centimetres is.
constexpr double kLargeMedian = 200.0;  // [m]
// Half of the points lie as near to their middle, compared with its distance, in a narrow view.
constexpr double kOneDirection = 0.05;
constexpr float kMetresPerMillimetre = 1e-3F;

/** Of the points that are one: finite and not at the origin. */
std::vector<Vec3> usablePoints(const PointColumns& points)
{
  std::vector<Vec3> usable;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3 point(
        static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
        static_cast<double>(points.z[i]));
    if (point.allFinite() && !point.isZero(0.0)) usable.push_back(point);
  }
  return usable;
}

double medianDistance(const std::vector<Vec3>& points, const Vec3& from)
{
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Vec3& point : points)
    distances.push_back((point - from).norm());
  return median(std::move(distances));
}

std::optional<RangeFinding> defectOf(const std::vector<Vec3>& points)
{
  const double range = medianDistance(points, Vec3::Zero());
  if (!(range > kLargeMedian)) return std::nullopt;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points)
    middle += point / static_cast<double>(points.size());
  const bool one_direction = medianDistance(points, middle) < kOneDirection * range;
  return RangeFinding{
      one_direction            ? RangeDefect::OneDirection
      : range > kLargestMedian ? RangeDefect::Millimetres
                               : RangeDefect::FarAway,
      range};
}
}  // namespace

std::string describe(const RangeFinding& finding)
{
  const std::string text = "the points of the LiDAR are " +
                           std::to_string(std::lround(finding.median)) + " away in the median";
  switch (finding.defect)
  {
    case RangeDefect::Millimetres:
      return text + ": they are taken as millimetres, not metres";
    case RangeDefect::FarAway:
      return text + ", farther than LiDARs see: are they centimetres? They have to be metres";
    case RangeDefect::OneDirection:
      break;
  }
  return text +
         ", all in one direction: they seem to be in the frame of a map; they have to be in "
         "the frame of the LiDAR";
}

std::optional<RangeFinding> RangeUnit::bringToMetres(PointColumns& points)
{
  std::optional<RangeFinding> found;
  if (!decided_)
  {
    const std::vector<Vec3> usable = usablePoints(points);
    if (usable.size() < kFewestUnitPoints) return std::nullopt;
    decided_ = true;
    found = defectOf(usable);
    millimetres_ = found && found->defect == RangeDefect::Millimetres;
  }
  if (!millimetres_) return found;
  for (auto* column : {&points.x, &points.y, &points.z})
    for (float& value : *column)
      value *= kMetresPerMillimetre;
  return found;
}

}  // namespace fastlio
