// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "local_points.h"
#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/plane_fit.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
/** Index cells of this many spacings search fastest on surfaces. */
constexpr double kCellPerSpacing = 3.0;
/** Cells when every point is kept [m]. */
constexpr double kCellWithoutSpacing = 0.5;

[[noreturn]] void throwOption(const std::string& name, const std::string& rule, double value)
{
  throw std::invalid_argument(
      "KnnSurfaceMap: " + name + " must be " + rule + ", but is " + std::to_string(value));
}

void requirePositive(const std::string& name, double value)
{
  if (!(value > 0.0)) throwOption(name, "above zero", value);
}

void requireNotNegative(const std::string& name, double value)
{
  if (!(value >= 0.0)) throwOption(name, "zero or more", value);
}

KnnSurfaceMapOptions checked(const KnnSurfaceMapOptions& o)
{
  if (o.neighbors < 3 || o.neighbors > kMaxNeighbors)
  {
    throwOption(
        "neighbors", "from 3 to " + std::to_string(kMaxNeighbors),
        static_cast<double>(o.neighbors));
  }
  requirePositive("max_neighbor_distance", o.max_neighbor_distance);
  requirePositive("max_plane_distance", o.max_plane_distance);
  requireNotNegative("min_spacing", o.min_spacing);
  requireNotNegative("cell_size", o.cell_size);
  requirePositive("point_noise", o.point_noise);
  requirePositive("point_noise_weight", o.point_noise_weight);
  requireNotNegative("removal_step", o.removal_step);
  return o;
}

CIncrementalPointsMap::TCreationOptions creationOptions(const KnnSurfaceMapOptions& o)
{
  CIncrementalPointsMap::TCreationOptions options;
  options.min_spacing = o.min_spacing;
  options.cell_size = o.cell_size;
  if (o.cell_size == 0.0)
  {
    options.cell_size = o.min_spacing > 0.0 ? kCellPerSpacing * o.min_spacing : kCellWithoutSpacing;
  }
  return options;
}

/** Whether every point is near enough to the plane to call it one. */
bool isFlat(const PlaneFit& fit, const LocalPoints& points, double max_distance)
{
  return std::all_of(
      points.begin(), points.end(),
      [&](const Eigen::Vector3d& p) { return std::abs(fit.distance(p)) <= max_distance; });
}

/** Variance of the map's points about the plane: prior and residuals, see KnnSurfaceMap. */
double pointVariance(const PlaneFit& fit, const KnnSurfaceMapOptions& o)
{
  const double squared_residuals = static_cast<double>(fit.count) * fit.eigenvalues[0];
  const double freedom = static_cast<double>(fit.count) - 3.0;
  return (o.point_noise_weight * o.point_noise * o.point_noise + squared_residuals) /
         (o.point_noise_weight + freedom);
}

void requireRange(std::size_t first, std::size_t last, std::size_t points, std::size_t matches)
{
  if (first <= last && last <= points && last <= matches) return;
  throw std::invalid_argument(
      "KnnSurfaceMap::match: the range [" + std::to_string(first) + ", " + std::to_string(last) +
      ") does not fit " + std::to_string(points) + " points and " + std::to_string(matches) +
      " matches; resize the matches first");
}
}  // namespace

KnnSurfaceMap::KnnSurfaceMap(const KnnSurfaceMapOptions& options)
    : options_(checked(options)), map_(creationOptions(options))
{
}

NeighborSet KnnSurfaceMap::kdTreeNeighborsOf(float x, float y, float z) const
{
  NeighborSet set;
  const std::size_t k = std::min(options_.neighbors, map_.size());
  if (k == 0 || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return set;
  std::vector<std::size_t> indices;
  std::vector<float> distances_sqr;
  map_.kdTreeNClosestPoint3DIdx(x, y, z, k, indices, distances_sqr);
  const double limit = options_.max_neighbor_distance * options_.max_neighbor_distance;
  for (std::size_t i = 0; i < k && distances_sqr[i] <= static_cast<float>(limit); ++i)
  {
    Neighbor& n = set.items[set.count++];
    map_.getPointFast(indices[i], n.x, n.y, n.z);
    n.distance_sqr = distances_sqr[i];
    n.point_index = static_cast<std::uint32_t>(indices[i]);
  }
  return set;
}

NeighborSet KnnSurfaceMap::neighborsOf(float x, float y, float z) const
{
  if (options_.engine == NeighborEngine::KdTree) return kdTreeNeighborsOf(x, y, z);
  return map_.nearest(x, y, z, options_.neighbors, options_.max_neighbor_distance);
}

PlaneMatch KnnSurfaceMap::matchPoint(float x, float y, float z) const
{
  const NeighborSet neighbors = neighborsOf(x, y, z);
  if (neighbors.size() < options_.neighbors) return {};
  const LocalPoints points = localPoints(neighbors, x, y, z);
  const auto fit = fitPlane(momentsOf(points.items.data(), points.count));
  if (!fit || !isFlat(*fit, points, options_.max_plane_distance)) return {};

  const double variance =
      planeOffsetVariance(*fit, Eigen::Vector3d::Zero(), pointVariance(*fit, options_));
  const double d = -fit->normal.dot(Eigen::Vector3d(x, y, z) + fit->centroid);
  return {
      static_cast<float>(fit->normal.x()), static_cast<float>(fit->normal.y()),
      static_cast<float>(fit->normal.z()), static_cast<float>(d), static_cast<float>(variance)};
}

void KnnSurfaceMap::match(
    const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches) const
{
  requireRange(first, last, points.size(), matches.size());
  for (std::size_t i = first; i < last; ++i)
  {
    matches[i] = matchPoint(points.x[i], points.y[i], points.z[i]);
  }
}

void KnnSurfaceMap::prepareEngine()
{
  // A const query would build the tree on first use; building it here keeps match() parallel.
  if (options_.engine == NeighborEngine::KdTree && map_.size() > 0) map_.kdTreeEnsureIndexBuilt3D();
}

void KnnSurfaceMap::insert(const WorldPoints& points, const Vec3& /*sensor_origin*/)
{
  map_.insertPoints(points.x.data(), points.y.data(), points.z.data(), points.size());
  prepareEngine();
}

void KnnSurfaceMap::removeOutside(const Vec3& center, double radius)
{
  const bool near_last = last_removal_center_ &&
                         (center - *last_removal_center_).norm() <= options_.removal_step * radius;
  if (near_last) return;
  last_removal_center_ = center;
  if (map_.removeOutside(center.x(), center.y(), center.z(), radius) > 0) prepareEngine();
}

mrpt::maps::CSimplePointsMap::Ptr KnnSurfaceMap::toPointsMap() const
{
  return std::make_shared<CIncrementalPointsMap>(map_);
}

}  // namespace fastlio
