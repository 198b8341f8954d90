// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "neighbor_fit.h"
#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/plane_fit.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr const char* kKnnMapName = "KnnSurfaceMap";

KnnSurfaceMapOptions checked(const KnnSurfaceMapOptions& o)
{
  requireCommonOptions(kKnnMapName, o);
  return o;
}

/** Whether every point is near enough to the plane to call it one. */
bool isFlat(const PlaneFit& fit, const LocalPoints& points, double max_distance)
{
  return std::all_of(
      points.begin(), points.end(),
      [&](const Eigen::Vector3d& p) { return std::abs(fit.distance(p)) <= max_distance; });
}

}  // namespace

KnnSurfaceMap::KnnSurfaceMap(const KnnSurfaceMapOptions& options)
    : options_(checked(options)), map_(options.min_spacing)
{
}

PlaneMatch KnnSurfaceMap::matchPoint(float x, float y, float z) const
{
  const NeighborSet neighbors = map_.nearest(x, y, z, kNeighbors, kMaxNeighborDistance);
  if (neighbors.size() < kNeighbors) return {};
  const LocalPoints points = localPoints(neighbors, x, y, z);
  const auto fit = fitPlane(momentsOf(points.items.data(), points.count));
  if (!fit || !isFlat(*fit, points, kMaxPlaneDistance)) return {};

  const auto n = static_cast<double>(fit->count);
  const double point_variance =
      pointVariance(n * fit->eigenvalues[0], n - 3.0, options_.point_noise);
  const double variance = planeOffsetVariance(*fit, Vec3::Zero(), point_variance);
  const double d = -fit->normal.dot(Eigen::Vector3d(x, y, z) + fit->centroid);
  return {
      static_cast<float>(fit->normal.x()), static_cast<float>(fit->normal.y()),
      static_cast<float>(fit->normal.z()), static_cast<float>(d), static_cast<float>(variance)};
}

void KnnSurfaceMap::match(
    const WorldPoints& points, const Vec3& /*sensor_origin*/, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches) const
{
  requireMatchRange(kKnnMapName, first, last, points.size(), matches.size());
  for (std::size_t i = first; i < last; ++i)
  {
    matches[i] = matchPoint(points.x[i], points.y[i], points.z[i]);
  }
}

void KnnSurfaceMap::insert(const WorldPoints& points, const Vec3& /*sensor_origin*/)
{
  map_.insertPoints(points.x.data(), points.y.data(), points.z.data(), points.size());
}

void KnnSurfaceMap::removeOutside(const Vec3& center, double radius)
{
  removeOutsideNowAndThen(map_, last_removal_center_, center, radius);
}

mrpt::maps::CSimplePointsMap::Ptr KnnSurfaceMap::toPointsMap() const
{
  return std::make_shared<CIncrementalPointsMap>(map_);
}

}  // namespace fastlio
