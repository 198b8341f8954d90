// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "neighbor_fit.h"
#include <fastlio/map/edge_map.h>
#include <fastlio/map/plane_fit.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr const char* kEdgeMapName = "EdgeMap";

EdgeMapOptions checked(const EdgeMapOptions& o)
{
  requireCommonOptions(kEdgeMapName, o);
  requireOption(
      o.max_line_distance > 0.0, kEdgeMapName, "max_line_distance", "above zero",
      o.max_line_distance);
  requireOption(
      o.min_elongation >= 1.0, kEdgeMapName, "min_elongation", "1 or more", o.min_elongation);
  return o;
}

bool isStraight(const LineFit& fit, const LocalPoints& points, double max_distance)
{
  return std::all_of(
      points.begin(), points.end(),
      [&](const Eigen::Vector3d& p) { return fit.distance(p) <= max_distance; });
}

/** Variance of one more point of the edge at the query, the origin; see EdgeMap. */
double predictionVariance(const LineFit& fit, const EdgeMapOptions& o)
{
  const auto n = static_cast<double>(fit.count);
  const double squared_residuals = n * (fit.eigenvalues[0] + fit.eigenvalues[1]);
  const double point_variance = pointVariance(squared_residuals, 2.0 * (n - 2.0), o);
  const double along = fit.direction.dot(fit.centroid);
  return point_variance * (1.0 + 1.0 / n + along * along / (n * fit.eigenvalues[2]));
}
}  // namespace

EdgeMap::EdgeMap(const EdgeMapOptions& options)
    : options_(checked(options)), map_(options.min_spacing)
{
}

LineMatch EdgeMap::matchPoint(float x, float y, float z) const
{
  const NeighborSet neighbors =
      map_.nearest(x, y, z, options_.neighbors, options_.max_neighbor_distance);
  if (neighbors.size() < options_.neighbors) return {};
  const LocalPoints points = localPoints(neighbors, x, y, z);
  const auto fit = fitLine(
      momentsOf(points.items.data(), points.count),
      options_.min_elongation * options_.min_elongation);
  if (!fit || !isStraight(*fit, points, options_.max_line_distance)) return {};
  const Eigen::Vector3d foot =
      fit->centroid - fit->direction.dot(fit->centroid) * fit->direction + Vec3(x, y, z);
  return {
      static_cast<float>(fit->direction.x()),
      static_cast<float>(fit->direction.y()),
      static_cast<float>(fit->direction.z()),
      static_cast<float>(foot.x()),
      static_cast<float>(foot.y()),
      static_cast<float>(foot.z()),
      static_cast<float>(predictionVariance(*fit, options_))};
}

void EdgeMap::match(
    const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<LineMatch>& matches) const
{
  requireMatchRange(kEdgeMapName, first, last, points.size(), matches.size());
  for (std::size_t i = first; i < last; ++i)
    matches[i] = matchPoint(points.x[i], points.y[i], points.z[i]);
}

void EdgeMap::insert(const WorldPoints& points)
{
  map_.insertPoints(points.x.data(), points.y.data(), points.z.data(), points.size());
}

void EdgeMap::removeOutside(const Vec3& center, double radius)
{
  removeOutsideNowAndThen(map_, last_removal_center_, center, radius);
}

}  // namespace fastlio
