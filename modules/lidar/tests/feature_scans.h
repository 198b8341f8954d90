// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file feature_scans.h Synthetic scans of simple scenes for the tests of the features. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/math/angles.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace fastlio::testing
{

/** Range along a unit direction from the origin; 0 or infinite: no echo. */
using RangeOf = std::function<double(const Vec3& direction)>;

/** A rectangular room around the sensor, turned by yaw: walls at +-half_x and +-half_y, floor and
 * ceiling far away. */
inline RangeOf roomRange(double half_x, double half_y, double yaw)
{
  return [=](const Vec3& u)
  {
    const double x = std::cos(yaw) * u.x() + std::sin(yaw) * u.y();
    const double y = -std::sin(yaw) * u.x() + std::cos(yaw) * u.y();
    return std::min({half_x / std::abs(x), half_y / std::abs(y), 20.0 / std::abs(u.z())});
  };
}

/** Distance of a point to the nearest of the four vertical edges of such a room [m]. */
inline double distanceToCorner(double half_x, double half_y, double yaw, const Vec3& p)
{
  const double x = std::cos(yaw) * p.x() + std::sin(yaw) * p.y();
  const double y = -std::sin(yaw) * p.x() + std::cos(yaw) * p.y();
  return std::hypot(std::abs(x) - half_x, std::abs(y) - half_y);
}

/** How a synthetic spinning sensor looks around. */
struct Spin
{
  int rings = 8;
  double step = 0.2 * kRadPerDeg;  //!< between columns
  double elevation_step = 2.0 * kRadPerDeg;
  double noise = 0.0;  //!< of a range [m]
  bool with_rings = true;
};

/** One revolution, all rings of a column at once and columns 50 us apart. */
inline PointColumns spin(const RangeOf& range_of, const Spin& sensor = {}, unsigned seed = 1)
{
  std::mt19937 rng(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  PointColumns points;
  const int columns = static_cast<int>(2.0 * M_PI / sensor.step);
  for (int column = 0; column < columns; ++column)
  {
    for (int ring = 0; ring < sensor.rings; ++ring)
    {
      const double azimuth = column * sensor.step - M_PI;
      const double elevation = (ring - 0.5 * (sensor.rings - 1)) * sensor.elevation_step;
      const Vec3 u(
          std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation));
      const double range = range_of(u);
      if (!(range > 0.0) || !std::isfinite(range)) continue;
      const Vec3 p = (range + sensor.noise * noise(rng)) * u;
      points.push_back(
          static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0.0F,
          column * 50000, static_cast<std::uint16_t>(sensor.with_rings ? ring : 0));
    }
  }
  return points;
}

inline Vec3 pointAt(const PointColumns& points, std::uint32_t i)
{
  return {points.x[i], points.y[i], points.z[i]};
}

inline double azimuthAt(const PointColumns& points, std::uint32_t i)
{
  return std::atan2(points.y[i], points.x[i]);
}

/** The chosen points in the given order. */
inline PointColumns permuted(const PointColumns& points, const std::vector<std::uint32_t>& order)
{
  PointColumns result;
  for (const std::uint32_t i : order)
    result.push_back(
        points.x[i], points.y[i], points.z[i], points.intensity[i], points.time_offset_ns[i],
        points.ring[i]);
  return result;
}

}  // namespace fastlio::testing
