// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "surface_distance.h"

#include <algorithm>
#include <cmath>

namespace fastlio::testing
{
namespace
{
double rectangleDistance(const Vec3& q, const Vec3& size)
{
  const double dx = std::max(std::abs(q.x()) - size.x(), 0.0);
  const double dy = std::max(std::abs(q.y()) - size.y(), 0.0);
  return Vec3(dx, dy, q.z()).norm();
}

double boxDistance(const Vec3& q, const Vec3& size)
{
  const Vec3 outside = q.cwiseAbs() - size;
  const double inside = std::min(outside.maxCoeff(), 0.0);
  return std::abs(outside.cwiseMax(0.0).norm() + inside);
}

double cylinderDistance(const Vec3& q, const Vec3& size)
{
  const double side = std::hypot(q.x(), q.y()) - size.x();
  const double lid = std::abs(q.z()) - size.z();
  const double inside = std::min(std::max(side, lid), 0.0);
  return std::abs(std::hypot(std::max(side, 0.0), std::max(lid, 0.0)) + inside);
}
}  // namespace

double surfaceDistance(const Primitive& primitive, const Vec3& point)
{
  const Vec3 q = primitive.T_world_local.inverse() * point;
  switch (primitive.shape)
  {
    case Primitive::Shape::Rectangle:
      return rectangleDistance(q, primitive.size);
    case Primitive::Shape::Box:
      return boxDistance(q, primitive.size);
    case Primitive::Shape::Cylinder:
      return cylinderDistance(q, primitive.size);
    case Primitive::Shape::Sphere:
      return std::abs(q.norm() - primitive.size.x());
    case Primitive::Shape::Foliage:
      return std::max(q.norm() - primitive.size.x(), 0.0);  // leaves are anywhere in it
  }
  return 0.0;
}

double surfaceDistance(const World& world, const Vec3& point, double t)
{
  const WorldDescription& parts = world.description();
  double least = 1e300;
  for (const auto& body : parts.bodies)
    least = std::min(least, surfaceDistance(body, point));
  for (const auto& object : parts.moving)
    least = std::min(least, surfaceDistance(object.at(t), point));
  if (parts.ground)
    least = std::min(least, std::abs(point.z() - parts.ground->height(point.x(), point.y())));
  return least;
}

}  // namespace fastlio::testing
