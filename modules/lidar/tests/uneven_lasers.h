// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file uneven_lasers.h Scans of spinning LiDARs whose lasers have given elevations. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace fastlio
{
/** Elevations of a Velodyne VLP-32C by firing order, from its manual [deg]. */
inline std::vector<double> vlp32cElevations()
{
  return {-25.0,  -1.0,   -1.667, -15.639, -11.31, 0.0,    -0.667, -8.843, -7.254, 0.333,  -0.333,
          -6.148, -5.333, 1.333,  0.667,   -4.0,   -4.667, 1.667,  1.0,    -3.667, -3.333, 3.333,
          2.333,  -2.667, -3.0,   7.0,     4.667,  -2.333, -2.0,   15.0,   10.333, -1.333};
}

/** As many lasers from \a lowest on, a step apart [deg]. */
inline std::vector<double> evenElevations(double lowest, double step, int lasers)
{
  std::vector<double> elevations;
  for (int i = 0; i < lasers; ++i)
    elevations.push_back(lowest + step * i);
  return elevations;
}

/** One turn, all lasers of a column at once. \param range by the beam's direction [m] */
inline PointColumns turnOf(
    const std::vector<double>& elevations_deg, int columns,
    const std::function<double(const Vec3&)>& range)
{
  PointColumns points;
  for (int column = 0; column < columns; ++column)
    for (std::size_t laser = 0; laser < elevations_deg.size(); ++laser)
    {
      const double azimuth = 2.0 * M_PI * column / columns;
      const double elevation = elevations_deg[laser] / kDegPerRad;
      const Vec3 u(
          std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation));
      const Vec3 p = range(u) * u;
      points.push_back(
          float(p.x()), float(p.y()), float(p.z()), 0.0F, 0, static_cast<std::uint16_t>(laser));
    }
  return points;
}

/** From the roof of a car in a street: asphalt 1.9 m below, walls 8 m to both sides. */
inline double rangeInStreet(const Vec3& u)
{
  const double ground = u.z() < 0.0 ? -1.9 / u.z() : 1e9;
  const double wall = 8.0 / std::max(std::abs(u.y()), 1e-9);
  return std::min({ground, wall, 80.0});
}

}  // namespace fastlio
