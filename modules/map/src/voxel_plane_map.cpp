// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/voxel_plane_map.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::int64_t kAxisBias = 1 << 20;

std::uint64_t axisIndex(float c, float inverse_size)
{
  return static_cast<std::uint64_t>(
      static_cast<std::int64_t>(std::floor(c * inverse_size)) + kAxisBias);
}

std::uint64_t voxelKey(float x, float y, float z, float inverse_size)
{
  return (axisIndex(x, inverse_size) << 42U) | (axisIndex(y, inverse_size) << 21U) |
         axisIndex(z, inverse_size);
}

Eigen::Vector3f voxelCenter(std::uint64_t key, float size)
{
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1U;
  const auto axis = [&](unsigned shift)
  {
    const auto i = static_cast<std::int64_t>((key >> shift) & kMask) - kAxisBias;
    return (static_cast<float>(i) + 0.5F) * size;
  };
  return {axis(42), axis(21), axis(0)};
}

/** Fits the plane of a voxel's sums. */
void fit(PlaneVoxel& voxel, float size, const VoxelPlaneOptions& options)
{
  voxel.fitted_count = voxel.count;
  voxel.variance = -1;
  if (voxel.count < static_cast<float>(options.min_points)) return;
  const double n = voxel.count;
  const Vec3 mean = Vec3(voxel.sum[0], voxel.sum[1], voxel.sum[2]) / n;
  Mat3 scatter;
  const auto& s = voxel.products;
  scatter << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  scatter = scatter / n - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(scatter);
  const Vec3 lambda = eigen.eigenvalues();
  const double noise2 = options.point_noise * options.point_noise;
  const double thickness = std::max(lambda[0], 0.0) * n / (n - 3.0);
  if (thickness > options.max_thickness * options.max_thickness) return;
  // A line of points, or a patch as thick as wide, fixes no normal.
  if (lambda[1] < 16.0 * std::max(thickness, noise2)) return;
  const Vec3 normal = eigen.eigenvectors().col(0);
  // One laser line on a bent surface spans a plane of its own that contains the beams.
  const Vec3 beam(voxel.beams[0], voxel.beams[1], voxel.beams[2]);
  if (std::abs(normal.dot(beam)) < options.min_incidence * n) return;
  const Vec3 centroid = mean + voxelCenter(voxel.key, size).cast<double>();
  voxel.nx = static_cast<float>(normal.x());
  voxel.ny = static_cast<float>(normal.y());
  voxel.nz = static_cast<float>(normal.z());
  voxel.d = static_cast<float>(-normal.dot(centroid));
  voxel.qx = static_cast<float>(centroid.x());
  voxel.qy = static_cast<float>(centroid.y());
  voxel.qz = static_cast<float>(centroid.z());
  const Vec3 e1 = eigen.eigenvectors().col(1), e2 = eigen.eigenvectors().col(2);
  const Mat3 M = (e1 * e1.transpose() / lambda[1] + e2 * e2.transpose() / lambda[2]) / n;
  voxel.leverage = {static_cast<float>(M(0, 0)), static_cast<float>(M(0, 1)),
                    static_cast<float>(M(0, 2)), static_cast<float>(M(1, 1)),
                    static_cast<float>(M(1, 2)), static_cast<float>(M(2, 2))};
  voxel.inverse_count = static_cast<float>(1.0 / n);
  voxel.variance = static_cast<float>(std::max(thickness, noise2));
}

/** Variance of the plane's offset at a point: of a regression's prediction. */
float predictionVariance(const PlaneVoxel& v, float x, float y, float z, float noise2)
{
  const float dx = x - v.qx, dy = y - v.qy, dz = z - v.qz;
  const auto& m = v.leverage;
  const float leverage = dx * (m[0] * dx + 2 * (m[1] * dy + m[2] * dz)) +
                         dy * (m[3] * dy + 2 * m[4] * dz) + dz * m[5] * dz;
  return v.variance * (v.inverse_count + leverage) + (v.variance - noise2);
}
}  // namespace

VoxelPlaneMap::VoxelPlaneMap(const VoxelPlaneOptions& options) : options_(options)
{
  levels_.resize(static_cast<std::size_t>(options.levels));
  double size = options.voxel_size;
  for (Level& level : levels_)
  {
    level.size = static_cast<float>(size);
    level.inverse_size = static_cast<float>(1.0 / size);
    size *= 2.0;
  }
}

void VoxelPlaneMap::match(
    const WorldPoints& points, std::size_t first, std::size_t last,
    std::vector<PlaneMatch>& matches) const
{
  const auto noise2 = static_cast<float>(options_.point_noise * options_.point_noise);
  for (std::size_t i = first; i < last; ++i)
  {
    PlaneMatch best;
    const float x = points.x[i], y = points.y[i], z = points.z[i];
    for (const Level& level : levels_)
    {
      const auto it = level.index.find(voxelKey(x, y, z, level.inverse_size));
      if (it == level.index.end()) continue;
      const PlaneVoxel& v = level.voxels[it->second];
      if (v.variance < 0) continue;
      const float variance = predictionVariance(v, x, y, z, noise2);
      if (best.valid() && variance >= best.variance) continue;
      best = {v.nx, v.ny, v.nz, v.d, variance};
    }
    matches[i] = best;
  }
}

void VoxelPlaneMap::insertPoint(Level& level, const Eigen::Vector3f& p, const Eigen::Vector3f& beam)
{
  const std::uint64_t key = voxelKey(p.x(), p.y(), p.z(), level.inverse_size);
  const auto [it, added] =
      level.index.try_emplace(key, static_cast<std::uint32_t>(level.voxels.size()));
  if (added)
  {
    level.voxels.emplace_back();
    level.voxels.back().key = key;
  }
  PlaneVoxel& v = level.voxels[it->second];
  const Eigen::Vector3f c = voxelCenter(key, level.size);
  const float dx = p.x() - c.x(), dy = p.y() - c.y(), dz = p.z() - c.z();
  for (int i = 0; i < 3; ++i)
    v.beams[static_cast<std::size_t>(i)] += beam[i];
  v.count += 1;
  v.sum[0] += dx;
  v.sum[1] += dy;
  v.sum[2] += dz;
  v.products[0] += dx * dx;
  v.products[1] += dx * dy;
  v.products[2] += dx * dz;
  v.products[3] += dy * dy;
  v.products[4] += dy * dz;
  v.products[5] += dz * dz;
  level.dirty.push_back(it->second);
}

void VoxelPlaneMap::refit(Level& level)
{
  for (const std::uint32_t i : level.dirty)
  {
    PlaneVoxel& v = level.voxels[i];
    if (v.count >= 1.1F * v.fitted_count + 1.0F) fit(v, level.size, options_);
  }
  level.dirty.clear();
}

void VoxelPlaneMap::insert(const WorldPoints& points, const Vec3& sensor_origin)
{
  const Eigen::Vector3f origin = sensor_origin.cast<float>();
  for (Level& level : levels_)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Eigen::Vector3f p(points.x[i], points.y[i], points.z[i]);
      insertPoint(level, p, (p - origin).normalized());
    }
    refit(level);
  }
}

void VoxelPlaneMap::removeOutside(const Vec3&, double) {}

std::size_t VoxelPlaneMap::pointCount() const
{
  return levels_.front().voxels.size();
}

mrpt::maps::CSimplePointsMap::Ptr VoxelPlaneMap::toPointsMap() const
{
  auto map = mrpt::maps::CSimplePointsMap::Create();
  for (const PlaneVoxel& v : levels_.front().voxels)
  {
    const Eigen::Vector3f c = voxelCenter(v.key, levels_.front().size);
    map->insertPoint(
        c.x() + v.sum[0] / v.count, c.y() + v.sum[1] / v.count, c.z() + v.sum[2] / v.count);
  }
  return map;
}

}  // namespace fastlio
