// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_test_tools.h Clouds to test maps with, and searches that look at every point. */
#pragma once

#include <fastlio/pointmap/incremental_points_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace fastlio::testing
{
struct Xyz
{
  float x = 0, y = 0, z = 0;
};

struct Cloud
{
  std::vector<Xyz> points;

  Cloud() = default;
  Cloud(std::initializer_list<Xyz> list) : points(list) {}
  void add(const Xyz& p) { points.push_back(p); }
  [[nodiscard]] std::size_t size() const { return points.size(); }
};

inline Cloud randomCloud(unsigned seed, std::size_t n, float extent)
{
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> u(-extent, extent);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i)
    cloud.add({u(rng), u(rng), u(rng)});
  return cloud;
}

/** Points on the six walls of a room of 40 x 24 x 6 m, with 1 cm of noise. */
inline Cloud roomCloud(unsigned seed, std::size_t n)
{
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> u(-1, 1);
  std::normal_distribution<float> noise(0, 0.01F);
  const float half[3] = {20, 12, 3};
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i)
  {
    float p[3] = {half[0] * u(rng), half[1] * u(rng), half[2] * u(rng)};
    const std::size_t axis = rng() % 8 < 5 ? 2 : rng() % 2;
    p[axis] = std::copysign(half[axis], u(rng)) + noise(rng);
    cloud.add({p[0], p[1], p[2]});
  }
  return cloud;
}

inline Cloud shuffled(Cloud cloud, unsigned seed)
{
  std::shuffle(cloud.points.begin(), cloud.points.end(), std::mt19937(seed));
  return cloud;
}

inline std::size_t insertAll(CIncrementalPointsMap& map, const Cloud& cloud)
{
  std::vector<float> x, y, z;
  for (const Xyz& p : cloud.points)
  {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  return map.insertPoints(x.data(), y.data(), z.data(), x.size());
}

inline Xyz pointOf(const mrpt::maps::CPointsMap& map, std::size_t i)
{
  Xyz p;
  map.getPointFast(i, p.x, p.y, p.z);
  return p;
}

inline double distance(const Xyz& a, const Xyz& b)
{
  return std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z);
}

/** The k nearest finite points by sorting all of them: by distance in double precision, then index.
 */
inline std::vector<Neighbor> bruteForce(
    const mrpt::maps::CPointsMap& map, const Xyz& q, std::size_t k, double max_distance)
{
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const double d = distance(pointOf(map, i), q);
    if (d <= max_distance) all.emplace_back(d * d, static_cast<std::uint32_t>(i));
  }
  std::sort(all.begin(), all.end());
  all.resize(std::min(k, all.size()));
  std::vector<Neighbor> nearest;
  for (const auto& [d, i] : all)
  {
    const Xyz p = pointOf(map, i);
    nearest.push_back({p.x, p.y, p.z, static_cast<float>(d), i});
  }
  return nearest;
}

/** Equal counts and, place by place, the same point, or another one at the same distance up to the
 * rounding of single precision. */
template <class Found>
bool sameNeighbors(const Found& found, const std::vector<Neighbor>& expected)
{
  if (found.size() != expected.size()) return false;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const float tolerance = 1e-6F * expected[i].distance_sqr;
    const float difference = std::abs(found[i].distance_sqr - expected[i].distance_sqr);
    if (!(difference <= tolerance)) return false;
    const bool rounding = difference > 0;
    if (found[i].point_index != expected[i].point_index && !rounding) return false;
  }
  return true;
}

inline bool sameColumns(
    const mrpt::maps::CPointsMap& map, const std::vector<mrpt::math::TPoint3Df>& points,
    const std::vector<float>& distances_sqr, const std::vector<std::uint64_t>& indices,
    const std::vector<Neighbor>& expected)
{
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto index = static_cast<std::uint32_t>(indices[i]);
    const Xyz p = pointOf(map, index);
    if (p.x != points[i].x || p.y != points[i].y || p.z != points[i].z) return false;
    found.push_back({p.x, p.y, p.z, distances_sqr[i], index});
  }
  return distances_sqr.size() == points.size() && indices.size() == points.size() &&
         sameNeighbors(found, expected);
}

template <class Found>
std::string describe(const Found& found, const std::vector<Neighbor>& expected)
{
  std::ostringstream out;
  out.precision(9);
  out << "found " << found.size() << ", expected " << expected.size() << '\n';
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
  {
    out << found[i].point_index << " at " << found[i].distance_sqr << " | "
        << expected[i].point_index << " at " << expected[i].distance_sqr << '\n';
  }
  return out.str();
}

/** Asks for neighbours all over the map and compares with brute force. */
inline void expectExactQueries(const CIncrementalPointsMap& map, unsigned seed, float extent)
{
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> u(-extent, extent);
  for (int i = 0; i < 40; ++i)
  {
    const Xyz q{u(rng), u(rng), u(rng)};
    for (const std::size_t k : {1U, 5U, 16U})
    {
      for (const double limit : {0.3, 2.0, std::numeric_limits<double>::infinity()})
      {
        const auto found = map.nearest(q.x, q.y, q.z, k, limit);
        const auto expected = bruteForce(map, q, k, limit);
        ASSERT_TRUE(sameNeighbors(found, expected)) << describe(found, expected);
      }
    }
  }
}

}  // namespace fastlio::testing
