// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "local_points.h"
#include <fastlio/map/edge_map.h>
#include <fastlio/map/plane_fit.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
/** Edge points are sparse: index cells that hold about as many as a query asks for [m]. */
constexpr double kCellSize = 1.0;

void require(bool holds, const char* name, const char* rule, double value)
{
  if (holds) return;
  throw std::invalid_argument(
      std::string("EdgeMap: ") + name + " must be " + rule + ", but is " + std::to_string(value));
}

EdgeMapOptions checked(const EdgeMapOptions& o)
{
  require(
      o.neighbors >= 3 && o.neighbors <= kMaxNeighbors, "neighbors", "from 3 to 16",
      static_cast<double>(o.neighbors));
  require(
      o.max_neighbor_distance > 0.0, "max_neighbor_distance", "above zero",
      o.max_neighbor_distance);
  require(o.max_line_distance > 0.0, "max_line_distance", "above zero", o.max_line_distance);
  require(o.min_elongation >= 1.0, "min_elongation", "1 or more", o.min_elongation);
  require(o.min_spacing >= 0.0, "min_spacing", "zero or more", o.min_spacing);
  require(o.point_noise > 0.0, "point_noise", "above zero", o.point_noise);
  require(o.point_noise_weight > 0.0, "point_noise_weight", "above zero", o.point_noise_weight);
  require(o.removal_step >= 0.0, "removal_step", "zero or more", o.removal_step);
  return o;
}

CIncrementalPointsMap::TCreationOptions creationOptions(const EdgeMapOptions& o)
{
  CIncrementalPointsMap::TCreationOptions options;
  options.min_spacing = o.min_spacing;
  options.cell_size = std::max(kCellSize, o.min_spacing);
  return options;
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
  const double point_variance =
      (o.point_noise_weight * o.point_noise * o.point_noise + squared_residuals) /
      (o.point_noise_weight + 2.0 * (n - 2.0));
  const double along = fit.direction.dot(fit.centroid);
  return point_variance * (1.0 + 1.0 / n + along * along / (n * fit.eigenvalues[2]));
}
}  // namespace

EdgeMap::EdgeMap(const EdgeMapOptions& options)
    : options_(checked(options)), map_(creationOptions(options))
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
  if (first > last || last > points.size() || last > matches.size())
    throw std::invalid_argument(
        "EdgeMap::match: the range [" + std::to_string(first) + ", " + std::to_string(last) +
        ") does not fit " + std::to_string(points.size()) + " points and " +
        std::to_string(matches.size()) + " matches; resize the matches first");
  for (std::size_t i = first; i < last; ++i)
    matches[i] = matchPoint(points.x[i], points.y[i], points.z[i]);
}

void EdgeMap::insert(const WorldPoints& points)
{
  map_.insertPoints(points.x.data(), points.y.data(), points.z.data(), points.size());
}

void EdgeMap::removeOutside(const Vec3& center, double radius)
{
  const bool near_last = last_removal_center_ &&
                         (center - *last_removal_center_).norm() <= options_.removal_step * radius;
  if (near_last) return;
  last_removal_center_ = center;
  map_.removeOutside(center.x(), center.y(), center.z(), radius);
}

}  // namespace fastlio
