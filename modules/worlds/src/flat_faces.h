// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file flat_faces.h Where rays from one point meet boxes and rectangles, several rays at once
 * (internal). Loops without branches, which become vector instructions. */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fastlio
{
constexpr double kNearestHit = 1e-6;  // rays meet nothing nearer to their origin [m]

/** A number for each of N rays. */
template <std::size_t N>
using Lanes = std::array<double, N>;

/** The first N of some directions in the frame of a body. \param R its axes in the rays' frame */
template <std::size_t N, std::size_t All>
std::array<Lanes<N>, 3> turned(const Mat3& R, const std::array<Lanes<All>, 3>& directions)
{
  const auto& [x, y, z] = directions;
  std::array<Lanes<N>, 3> local;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Vec3 along = R.col(static_cast<Eigen::Index>(axis));
    for (std::size_t i = 0; i < N; ++i)
      local[axis][i] = along.x() * x[i] + along.y() * y[i] + along.z() * z[i];
  }
  return local;
}

/** The same for one direction: the same digits, whatever instructions the compiler takes. */
inline Vec3 turned(const Mat3& R, const Vec3& d)
{
  const auto [x, y, z] = turned<1>(R, std::array<Lanes<1>, 3>{{{d.x()}, {d.y()}, {d.z()}}});
  return {x[0], y[0], z[0]};
}

/** Rays in the frame of a body. */
template <std::size_t N>
struct LocalRays
{
  Vec3 origin;
  std::array<Lanes<N>, 3> direction;  // x, y and z
};

/** Where each ray meets the body, as in BodyHit. */
template <std::size_t N>
struct FaceHits
{
  Lanes<N> range;  // [m]; infinite: nowhere
  Lanes<N> axis;   // along which the normal of the face is: 0, 1 or 2
};

template <std::size_t N>
FaceHits<N> hitRectangle(const LocalRays<N>& rays, const Vec3& size)
{
  const auto& [o, d] = rays;
  FaceHits<N> hits;
  for (std::size_t i = 0; i < N; ++i)
  {
    const double t = -o.z() / d[2][i];
    const double x = std::abs(o.x() + t * d[0][i]), y = std::abs(o.y() + t * d[1][i]);
    const bool is_hit = x <= size.x() && y <= size.y() && t > kNearestHit;
    hits.range[i] = is_hit ? t : std::numeric_limits<double>::infinity();
    hits.axis[i] = 2.0;
  }
  return hits;
}

template <std::size_t N>
FaceHits<N> hitBox(const LocalRays<N>& rays, const Vec3& size)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  FaceHits<N> enter, leave;
  enter.range.fill(-kInfinity), leave.range.fill(kInfinity);
  enter.axis.fill(0.0), leave.axis.fill(0.0);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto component = static_cast<Eigen::Index>(axis);
    const double low = -size[component] - rays.origin[component];
    const double high = size[component] - rays.origin[component];
    const auto number = static_cast<double>(axis);
    for (std::size_t i = 0; i < N; ++i)
    {
      const double inverse = 1.0 / rays.direction[axis][i];
      const double a = low * inverse, b = high * inverse;
      const double near = b < a ? b : a, far = a < b ? b : a;
      enter.axis[i] = near > enter.range[i] ? number : enter.axis[i];
      enter.range[i] = near > enter.range[i] ? near : enter.range[i];
      leave.axis[i] = far < leave.range[i] ? number : leave.axis[i];
      leave.range[i] = far < leave.range[i] ? far : leave.range[i];
    }
  }
  // From inside, a ray meets the face where it leaves.
  for (std::size_t i = 0; i < N; ++i)
  {
    const bool misses = enter.range[i] > leave.range[i];
    const bool from_outside = enter.range[i] > kNearestHit;
    const double range = from_outside ? enter.range[i] : leave.range[i];
    enter.axis[i] = from_outside ? enter.axis[i] : leave.axis[i];
    enter.range[i] = misses || !(range > kNearestHit) ? kInfinity : range;
  }
  return enter;
}

}  // namespace fastlio
