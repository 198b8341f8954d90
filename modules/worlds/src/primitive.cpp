// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "flat_faces.h"
#include <fastlio/worlds/primitive.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace fastlio
{
namespace
{
constexpr double kNoHit = std::numeric_limits<double>::infinity();

void keepNearer(BodyHit& best, double t, const Vec3& normal)
{
  if (t > kNearestHit && t < best.range) best = {t, normal};
}

/** The hit of the only ray. */
BodyHit onlyHit(const FaceHits<1>& hits)
{
  if (!(hits.range[0] < kNoHit)) return {};
  return {hits.range[0], Vec3::Unit(static_cast<Eigen::Index>(hits.axis[0]))};
}

BodyHit hitSphere(const Vec3& o, const Vec3& d, double radius)
{
  const double b = o.dot(d);
  const double discriminant = b * b - o.squaredNorm() + radius * radius;
  BodyHit hit;
  if (discriminant < 0.0) return hit;
  const double root = std::sqrt(discriminant);
  for (const double t : {-b - root, -b + root})
    keepNearer(hit, t, (o + t * d) / radius);
  return hit;
}

/** Whether there is a leaf in a cell: a fixed number per cell, since trees stand still. */
bool holdsLeaf(const Vec3& p, double cell, double share)
{
  constexpr std::array<std::uint64_t, 3> kPrimes{73856093U, 19349663U, 83492791U};
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double index = std::floor(p[static_cast<Eigen::Index>(i)] / cell);
    hash ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(index)) * kPrimes[i];
  }
  hash = (hash ^ (hash >> 31U)) * 0x9E3779B97F4A7C15U;
  return static_cast<double>(hash >> 40U) < share * 16777216.0;
}

BodyHit hitFoliage(const Vec3& o, const Vec3& d, double radius)
{
  constexpr double kLeaf = 0.1, kFreePath = 0.6;  // [m]
  const double b = o.dot(d);
  const double discriminant = b * b - o.squaredNorm() + radius * radius;
  BodyHit hit;
  if (discriminant < 0.0) return hit;
  const double leave = -b + std::sqrt(discriminant);
  for (double t = std::max(-b - std::sqrt(discriminant), 0.0) + 0.5 * kLeaf; t < leave; t += kLeaf)
    if (holdsLeaf(o + t * d, kLeaf, kLeaf / kFreePath))
    {
      keepNearer(hit, t, -d);
      return hit;
    }
  return hit;
}

BodyHit hitCylinder(const Vec3& o, const Vec3& d, const Vec3& size)
{
  BodyHit hit;
  const double radius = size.x();
  for (const double lid : {-size.z(), size.z()})
  {
    const double t = (lid - o.z()) / d.z();
    const Vec3 p = o + t * d;
    if (p.x() * p.x() + p.y() * p.y() <= radius * radius) keepNearer(hit, t, Vec3::UnitZ());
  }
  const double a = d.x() * d.x() + d.y() * d.y();
  const double b = o.x() * d.x() + o.y() * d.y();
  const double c = o.x() * o.x() + o.y() * o.y() - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0 || a <= 0.0) return hit;
  const double root = std::sqrt(discriminant);
  for (const double t : {(-b - root) / a, (-b + root) / a})
  {
    const Vec3 p = o + t * d;
    if (std::abs(p.z()) <= size.z()) keepNearer(hit, t, Vec3(p.x(), p.y(), 0.0) / radius);
  }
  return hit;
}

Vec3 localHalfExtents(const Primitive& primitive)
{
  const Vec3& s = primitive.size;
  switch (primitive.shape)
  {
    case Primitive::Shape::Rectangle:
      return {s.x(), s.y(), 0.0};
    case Primitive::Shape::Box:
      return s;
    case Primitive::Shape::Cylinder:
      return {s.x(), s.x(), s.z()};
    case Primitive::Shape::Sphere:
    case Primitive::Shape::Foliage:
      return Vec3::Constant(s.x());
  }
  return s;
}
}  // namespace

BodyHit intersectLocal(const Primitive& primitive, const Ray& local)
{
  const auto& [o, d] = local;
  const LocalRays<1> alone{o, {{{d.x()}, {d.y()}, {d.z()}}}};
  switch (primitive.shape)
  {
    case Primitive::Shape::Rectangle:
      return onlyHit(hitRectangle(alone, primitive.size));
    case Primitive::Shape::Box:
      return onlyHit(hitBox(alone, primitive.size));
    case Primitive::Shape::Cylinder:
      return hitCylinder(o, d, primitive.size);
    case Primitive::Shape::Sphere:
      return hitSphere(o, d, primitive.size.x());
    case Primitive::Shape::Foliage:
      return hitFoliage(o, d, primitive.size.x());
  }
  return {};
}

RayHit worldHit(const Primitive& primitive, const BodyHit& hit, const Vec3& local_direction)
{
  const Vec3 towards = hit.normal.dot(local_direction) > 0.0 ? Vec3(-hit.normal) : hit.normal;
  return {
      hit.range, primitive.T_world_local.R * towards, primitive.reflectivity,
      isFlat(primitive.shape)};
}

std::optional<RayHit> intersect(const Primitive& primitive, const Ray& ray)
{
  const Mat3& R = primitive.T_world_local.R;
  const Ray local{
      R.transpose() * (ray.origin - primitive.T_world_local.p), turned(R, ray.direction)};
  const BodyHit hit = intersectLocal(primitive, local);
  if (!(hit.range < kNoHit)) return std::nullopt;
  return worldHit(primitive, hit, local.direction);
}

void Bounds::include(const Bounds& other)
{
  min = min.cwiseMin(other.min);
  max = max.cwiseMax(other.max);
}

Bounds boundsOf(const Primitive& primitive)
{
  const Vec3 half = primitive.T_world_local.R.cwiseAbs() * localHalfExtents(primitive) +
                    Vec3::Constant(1e-9);  // rounding must not lose grazing hits
  return {primitive.T_world_local.p - half, primitive.T_world_local.p + half};
}

}  // namespace fastlio
