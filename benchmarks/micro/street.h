// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file street.h Points as a vehicle sees them in a street: ground, walls, and noise of 2 cm. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/map/surface_map.h>

#include <cmath>
#include <random>

namespace fastlio::benchmarks
{
/** \a count points on 2000 m^2 of ground and walls per 10^4 of them: the density of a map, whatever
 * its size. */
inline WorldPoints streetPoints(std::size_t count, unsigned seed)
{
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> u(0.0F, 1.0F);
  std::normal_distribution<float> noise(0.0F, 0.02F);
  const float length = static_cast<float>(count) / 10000.0F * 50.0F;
  WorldPoints points;
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const bool ground = i % 2 == 0;
    // Streets side by side, so that the coordinates stay small.
    const float along = u(rng) * length;
    points.x[i] = std::fmod(along, 500.0F);
    points.y[i] = std::floor(along / 500.0F) * 40.0F +
                  (ground ? 20.0F * u(rng) : (u(rng) < 0.5F ? 0.0F : 20.0F) + noise(rng));
    points.z[i] = ground ? noise(rng) : 20.0F * u(rng);
  }
  return points;
}

/** A sweep of 16 lines in a box of 20 m x 30 m x 6 m, without motion but with times. */
inline LidarScan boxScan(std::size_t count)
{
  constexpr std::size_t kLines = 16;
  LidarScan scan;
  scan.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double turn = static_cast<double>(i) / static_cast<double>(count);
    const double azimuth = 2.0 * M_PI * turn;
    const double elevation = 0.035 * (static_cast<double>(i % kLines) - 7.5);
    const double x = std::cos(elevation) * std::cos(azimuth);
    const double y = std::cos(elevation) * std::sin(azimuth), z = std::sin(elevation);
    const double range =
        1.0 / std::max({std::abs(x) / 10.0, std::abs(y) / 15.0, std::abs(z) / 3.0});
    scan.points.push_back(
        static_cast<float>(range * x), static_cast<float>(range * y), static_cast<float>(range * z),
        0.0F, static_cast<std::int32_t>(1e8 * turn), static_cast<std::uint16_t>(i % kLines));
  }
  return scan;
}
}  // namespace fastlio::benchmarks
