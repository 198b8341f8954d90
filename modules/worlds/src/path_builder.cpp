// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "path_timing.h"
#include <fastlio/math/angles.h>
#include <fastlio/worlds/path_builder.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
constexpr double kSampleDistance = 0.05;  // of the polyline before smoothing [m]
constexpr double kKnotTime = 0.4;         // between the spline's control points [s]

using Points = std::vector<Vec3>;

std::vector<double> closedArcLengths(const Points& p)
{
  std::vector<double> lengths{0.0};
  for (std::size_t i = 0; i < p.size(); ++i)
    lengths.push_back(lengths.back() + (p[(i + 1) % p.size()] - p[i]).norm());
  return lengths;
}

/** Closed polyline of n points at equal distances along a closed polyline. \param at arc length (or
 * time) of each corner; the last element closes the loop */
Points resample(const Points& corners, const std::vector<double>& at, std::size_t n)
{
  Points result;
  std::size_t segment = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double s = at.back() * static_cast<double>(i) / static_cast<double>(n);
    while (at[segment + 1] < s)
      ++segment;
    const double fraction = (s - at[segment]) / std::max(at[segment + 1] - at[segment], 1e-12);
    const Vec3& a = corners[segment];
    result.push_back(a + fraction * (corners[(segment + 1) % corners.size()] - a));
  }
  return result;
}

/** Moving average over 2 half + 1 points of a closed polyline. */
Points averaged(const Points& p, std::size_t half)
{
  Points result;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k <= 2 * half; ++k)
      sum += p[(i + n + k - half) % n];
    result.push_back(sum / static_cast<double>(2 * half + 1));
  }
  return result;
}

Points roundedRoute(const Route& route)
{
  const std::vector<double> lengths = closedArcLengths(route.corners);
  const auto n = static_cast<std::size_t>(std::ceil(lengths.back() / kSampleDistance)) + 1;
  const auto half = static_cast<std::size_t>(
      std::clamp(0.5 * route.corner_cut / kSampleDistance, 0.0, 0.25 * static_cast<double>(n)));
  return averaged(averaged(resample(route.corners, lengths, n), half), half);
}

/** Directions of travel, without jumps of 2 pi; the last element closes the loop. */
std::vector<double> headings(const Points& p)
{
  std::vector<double> result;
  for (std::size_t i = 0; i <= p.size(); ++i)
  {
    const Vec3 ahead = p[(i + 1) % p.size()] - p[(i + p.size() - 1) % p.size()];
    double heading = std::atan2(ahead.y(), ahead.x());
    if (!result.empty()) heading = result.back() + std::remainder(heading - result.back(), 2 * kPi);
    result.push_back(heading);
  }
  return result;
}

void requireValid(const Route& route)
{
  const bool valid = route.corners.size() >= 2 && route.speed > 0.0 &&
                     closedArcLengths(route.corners).back() > 0.0;
  if (valid) return;
  throw std::invalid_argument(
      "Route: " + std::to_string(route.corners.size()) + " corners, " +
      std::to_string(route.speed) + " m/s; needed are two different corners and a positive speed.");
}

UniformSpline coordinate(const Points& points, Eigen::Index axis, double spacing)
{
  std::vector<double> control;
  for (const auto& p : points)
    control.push_back(p[axis]);
  return {std::move(control), spacing};
}
}  // namespace

CarrierPath followRoute(const Route& route)
{
  requireValid(route);
  const Points rounded = roundedRoute(route);
  const bool steady = route.acceleration <= 0.0;
  const std::vector<double> at = steady ? closedArcLengths(rounded) : timesAlong(rounded, route);
  const double step = steady ? route.speed * kKnotTime : kKnotTime;
  const auto n = static_cast<std::size_t>(std::max(8.0, std::round(at.back() / step)));
  Points points = resample(rounded, at, n);
  const double spacing = (steady ? at.back() / route.speed : at.back()) / static_cast<double>(n);
  if (route.ground)
    for (auto& p : points)
      p.z() += route.ground(p.x(), p.y());

  CarrierPath path;
  path.loop_time = spacing * static_cast<double>(n);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    path.channels[static_cast<std::size_t>(axis)].spline = coordinate(points, axis, spacing);
  std::vector<double> yaw = headings(points);
  const double winding = yaw.back() - yaw.front();
  yaw.pop_back();
  path.channels[CarrierPath::kYaw].spline = UniformSpline(std::move(yaw), spacing, winding);
  return path;
}

void addOscillation(
    CarrierPath& path, CarrierPath::Channel channel, double amplitude, double frequency)
{
  const double periods = std::max(1.0, std::round(frequency * path.loop_time));
  const double closing = path.loop_time > 0.0 ? periods / path.loop_time : frequency;
  path.channels[channel].oscillations.push_back({amplitude, 2.0 * kPi * closing});
}

void addWalkingSway(CarrierPath& path, double step_frequency, double strength)
{
  const double stride = 0.5 * step_frequency;
  path.channels[CarrierPath::kPitch].offset += 0.09 * strength;
  path.channels[CarrierPath::kRoll].offset -= 0.06 * strength;
  addOscillation(path, CarrierPath::kZ, 0.02 * strength, step_frequency);
  addOscillation(path, CarrierPath::kX, 0.01 * strength, 1.03 * stride);
  addOscillation(path, CarrierPath::kY, 0.01 * strength, 0.97 * stride);
  addOscillation(path, CarrierPath::kRoll, 0.03 * strength, stride);
  addOscillation(path, CarrierPath::kPitch, 0.02 * strength, step_frequency);
  addOscillation(path, CarrierPath::kPitch, 0.04 * strength, 0.21);
  addOscillation(path, CarrierPath::kYaw, 0.04 * strength, 0.9 * stride);
  addOscillation(path, CarrierPath::kYaw, 0.12 * strength, 0.17);
}

void addThrustTilt(CarrierPath& path, double gravity)
{
  constexpr double kSpacing = 0.25;
  const auto n = static_cast<std::size_t>(std::max(8.0, std::round(path.loop_time / kSpacing)));
  const double spacing = path.loop_time / static_cast<double>(n);
  std::vector<double> pitch, roll;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double u = spacing * static_cast<double>(i);
    const Vec3 thrust(
        path.channels[CarrierPath::kX].at(u).second, path.channels[CarrierPath::kY].at(u).second,
        path.channels[CarrierPath::kZ].at(u).second + gravity);
    const double yaw = path.channels[CarrierPath::kYaw].value(u);
    const double ahead = std::cos(yaw) * thrust.x() + std::sin(yaw) * thrust.y();
    const double left = -std::sin(yaw) * thrust.x() + std::cos(yaw) * thrust.y();
    pitch.push_back(std::atan2(ahead, thrust.z()));
    roll.push_back(-std::asin(left / thrust.norm()));
  }
  path.channels[CarrierPath::kPitch].spline = UniformSpline(std::move(pitch), spacing);
  path.channels[CarrierPath::kRoll].spline = UniformSpline(std::move(roll), spacing);
}

void addGroundTilt(CarrierPath& path, const std::function<double(double x, double y)>& ground)
{
  constexpr double kSpacing = 0.5, kHalfBase = 0.7;  // [s], [m]
  const auto n = static_cast<std::size_t>(std::max(8.0, std::round(path.loop_time / kSpacing)));
  const double spacing = path.loop_time / static_cast<double>(n);
  std::vector<double> pitch, roll;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double u = spacing * static_cast<double>(i);
    const double x = path.channels[CarrierPath::kX].value(u);
    const double y = path.channels[CarrierPath::kY].value(u);
    const double yaw = path.channels[CarrierPath::kYaw].value(u);
    const double dx = kHalfBase * std::cos(yaw), dy = kHalfBase * std::sin(yaw);
    const double ahead = ground(x + dx, y + dy) - ground(x - dx, y - dy);
    const double left = ground(x - dy, y + dx) - ground(x + dy, y - dx);
    pitch.push_back(-std::atan2(ahead, 2.0 * kHalfBase));
    roll.push_back(std::atan2(left, 2.0 * kHalfBase));
  }
  path.channels[CarrierPath::kPitch].spline = UniformSpline(std::move(pitch), spacing);
  path.channels[CarrierPath::kRoll].spline = UniformSpline(std::move(roll), spacing);
}

double loopLength(const CarrierPath& path)
{
  constexpr double kStep = 0.01;
  const auto n = static_cast<std::size_t>(std::ceil(path.loop_time / kStep));
  double length = 0.0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double u = path.loop_time * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    length +=
        Vec3(
            path.channels[CarrierPath::kX].at(u).first, path.channels[CarrierPath::kY].at(u).first,
            path.channels[CarrierPath::kZ].at(u).first)
            .norm();
  }
  return n == 0 ? 0.0 : length * path.loop_time / static_cast<double>(n);
}

}  // namespace fastlio
