// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file downsampling_scans.h Scans for tests of downsampling. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <cstddef>
#include <functional>
#include <random>

namespace fastlio
{
inline void append(PointColumns& points, float x, float y, float z)
{
  points.push_back(x, y, z, 0.0F, 0, 0);
}

/** Points in random directions at ranges that a function draws. */
inline PointColumns randomScan(std::size_t n, const std::function<double(std::mt19937&)>& range)
{
  std::mt19937 rng(7);
  std::normal_distribution<double> normal;
  PointColumns points;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 p = range(rng) * Vec3(normal(rng), normal(rng), normal(rng)).normalized();
    append(points, float(p.x()), float(p.y()), float(p.z()));
  }
  return points;
}

inline PointColumns scanAtRange(std::size_t n, double range)
{
  return randomScan(n, [range](std::mt19937&) { return range; });
}

}  // namespace fastlio
