// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file surface_map_test_tools.h Clouds into maps of surfaces and planes out of them. */
#pragma once

#include "map_test_tools.h"
#include <fastlio/map/surface_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <Eigen/Core>

#include <random>
#include <vector>

namespace fastlio::testing
{
constexpr float kSize = 0.5F;  // exact in binary, as are its multiples

/** Finest voxels of kSize. */
inline VoxelPlaneOptions halfMetre()
{
  VoxelPlaneOptions o;
  o.voxel_size = kSize;
  o.rules.point_noise = 0.01F;
  return o;
}

/** Points on z = height, |x - x0|, |y - y0| < half, seen from 3 m above the middle with noise along
 * the beams. */
inline Cloud patch(float x0, float y0, float height, float half, std::size_t n, float noise = 0.01F)
{
  std::mt19937 rng(5);
  std::uniform_real_distribution<float> u(-half, half);
  std::normal_distribution<float> e(0.0F, 1.0F);
  const Eigen::Vector3f sensor(x0, y0, height + 3.0F);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Eigen::Vector3f p(x0 + u(rng), y0 + u(rng), height);
    const Eigen::Vector3f measured = p + noise * e(rng) * (p - sensor).normalized();
    cloud.add({measured.x(), measured.y(), measured.z()});
  }
  return cloud;
}

inline WorldPoints worldPoints(const Cloud& cloud)
{
  WorldPoints points;
  points.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    points.x[i] = cloud.points[i].x;
    points.y[i] = cloud.points[i].y;
    points.z[i] = cloud.points[i].z;
  }
  return points;
}

/** Of a sensor that sees all that lies flat from above [m]. */
inline const Vec3 kHighAbove(0.0, 0.0, 1e4);

inline std::vector<PlaneMatch> matchAll(
    const SurfaceMap& map, const WorldPoints& points, const Vec3& sensor_origin = kHighAbove)
{
  std::vector<PlaneMatch> matches(points.size());
  map.match(points, sensor_origin, 0, points.size(), matches);
  return matches;
}

inline PlaneMatch matchOne(
    const SurfaceMap& map, const Xyz& p, const Vec3& sensor_origin = kHighAbove)
{
  return matchAll(map, worldPoints({p}), sensor_origin).front();
}

/** Signed distance of a point from the plane of a match [m]. */
inline double residual(const PlaneMatch& m, const Xyz& p)
{
  return double(m.nx) * p.x + double(m.ny) * p.y + double(m.nz) * p.z + m.d;
}
}  // namespace fastlio::testing
