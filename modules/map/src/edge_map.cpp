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
constexpr std::size_t kNeighbors = 5;         // that make a line
constexpr double kMaxNeighborDistance = 2.0;  // the farthest neighbour [m]
constexpr double kMaxLineDistance = 0.15;     // a neighbour farther away makes it no line [m]
// The neighbours' standard deviation along the line over that across it, at least.
constexpr double kMinElongation = 3.0;

EdgeMapOptions checked(const EdgeMapOptions& o)
{
  requireCommonOptions(kEdgeMapName, o);
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
  const double point_variance = pointVariance(squared_residuals, 2.0 * (n - 2.0), o.point_noise);
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
  const NeighborSet neighbors = map_.nearest(x, y, z, kNeighbors, kMaxNeighborDistance);
  if (neighbors.size() < kNeighbors) return {};
  const LocalPoints points = localPoints(neighbors, x, y, z);
  const auto fit =
      fitLine(momentsOf(points.items.data(), points.count), kMinElongation * kMinElongation);
  if (!fit || !isStraight(*fit, points, kMaxLineDistance)) return {};
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
