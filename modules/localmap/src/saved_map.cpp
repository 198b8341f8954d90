// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/saved_map.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kNeighbors = 8;
constexpr double kFarthestNeighbor = 1.0;  // [m]
// A surface is thinner than this fraction of its extent.
constexpr double kMaxThicknessRatio = 0.2;
// A sensor so far away sees all points of a group from one direction.
constexpr double kFar = 1e4;  // [m]
// Points without a surface of their own join all the same. Without them, a wide voxel would take
// the floor below a bush for all that it holds. From a corner of the cube no wall, floor or ceiling
// is seen edge-on.
const Vec3 kSeenFromACorner(1.0, 1.0, 1.0);

/** The directions to faces, edges and corners of a cube, without their opposites: every normal is
 * within 28 degrees of one of them. */
std::vector<Vec3> viewingDirections()
{
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (9 * x + 3 * y + z > 0) directions.push_back(Vec3(x, y, z).normalized());
  return directions;
}

Vec3 pointOf(const mrpt::maps::CPointsMap& map, std::size_t i)
{
  return {
      static_cast<double>(map.getPointsBufferRef_x()[i]),
      static_cast<double>(map.getPointsBufferRef_y()[i]),
      static_cast<double>(map.getPointsBufferRef_z()[i])};
}

/** Zero when the neighbours make no surface. */
Vec3 normalAt(const CIncrementalPointsMap& map, std::size_t i)
{
  const Vec3 p = pointOf(map, i);
  const NeighborSet near = map.nearest(
      static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), kNeighbors,
      kFarthestNeighbor);
  if (near.count < kNeighbors / 2) return Vec3::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < near.count; ++k)
  {
    const Eigen::Vector3d offset = pointOf(map, near[k].point_index) - p;
    mean += offset;
    scatter += offset * offset.transpose();
  }
  const auto n = static_cast<double>(near.count);
  scatter -= mean * mean.transpose() / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d extents = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (extents[0] > kMaxThicknessRatio * extents[1]) return Vec3::Zero();
  return solver.eigenvectors().col(0);
}

std::size_t nearestDirection(const std::vector<Vec3>& directions, const Vec3& normal)
{
  std::size_t best = 0;
  for (std::size_t i = 1; i < directions.size(); ++i)
    if (std::abs(directions[i].dot(normal)) > std::abs(directions[best].dot(normal))) best = i;
  return best;
}

WorldPoints finitePoints(const WorldPoints& points)
{
  WorldPoints finite;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points.x[i]) && std::isfinite(points.y[i]) && std::isfinite(points.z[i]))
      finite.add(points.x[i], points.y[i], points.z[i]);
  return finite;
}
}  // namespace

void insertSavedPoints(const WorldPoints& points, SurfaceMap& map)
{
  const WorldPoints finite = finitePoints(points);
  CIncrementalPointsMap index;
  index.insertPoints(finite.x.data(), finite.y.data(), finite.z.data(), finite.size());
  const std::vector<Vec3> directions = viewingDirections();
  std::vector<WorldPoints> groups(directions.size());
  for (std::size_t i = 0; i < index.size(); ++i)
  {
    Vec3 normal = normalAt(index, i);
    if (normal.isZero()) normal = kSeenFromACorner;
    groups[nearestDirection(directions, normal)].add(pointOf(index, i));
  }
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    if (groups[i].size() == 0) continue;
    // Points do not tell from which side they were seen: each surface has both.
    map.insert(groups[i], kFar * directions[i]);
    map.insert(groups[i], -kFar * directions[i]);
  }
}

}  // namespace fastlio
