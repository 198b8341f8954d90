// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file primitive.h Simple bodies and their intersection with rays. */
#pragma once

#include <fastlio/math/pose.h>

#include <limits>
#include <optional>

namespace fastlio
{
/** A half line. */
struct Ray
{
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();  //!< unit length
};

/** Where a ray meets a surface. */
struct RayHit
{
  double range = 0.0;           //!< distance along the ray [m]
  Vec3 normal = Vec3::UnitZ();  //!< unit normal of the surface, towards the ray's origin
  double reflectivity = 0.0;    //!< fraction of light that is scattered back, 0..1
  bool flat = false;            //!< on a flat face of a body, where a pane can be
};

/** A body in its own frame, placed in the frame that contains it. */
struct Primitive
{
  enum class Shape
  {
    Rectangle,  //!< in the plane z = 0, |x| <= size.x, |y| <= size.y; seen from both sides
    Box,        //!< |x|, |y|, |z| <= size; seen from inside too (rooms, tunnels)
    Cylinder,   //!< around z: radius size.x, |z| <= size.z, with lids
    Sphere,     //!< radius size.x
    Foliage     //!< a sphere of radius size.x that leaves fill: rays end at random depths
  };

  Shape shape = Shape::Box;
  Pose T_world_local;
  Vec3 size = Vec3::Ones();  //!< half extents or radius [m], see Shape
  double reflectivity = 0.4;
};

/** Whether all faces of a shape are flat, so that a pane can be there. */
[[nodiscard]] inline bool isFlat(Primitive::Shape shape)
{
  return shape == Primitive::Shape::Rectangle || shape == Primitive::Shape::Box;
}

/** Nearest intersection farther than 1e-6 m. */
[[nodiscard]] std::optional<RayHit> intersect(const Primitive& primitive, const Ray& ray);

/** Where a ray meets a body, in the frame of the body. */
struct BodyHit
{
  double range = std::numeric_limits<double>::infinity();  //!< along the ray [m]; infinite: nowhere
  Vec3 normal = Vec3::UnitZ();                             //!< unit normal, outward
};

/** intersect() for a ray in the frame of the primitive; whoever casts many rays from one point into
 * one body moves that point once. */
[[nodiscard]] BodyHit intersectLocal(const Primitive& primitive, const Ray& local);

/** A hit of a ray in the frame of the primitive as a hit in the world. */
[[nodiscard]] RayHit worldHit(
    const Primitive& primitive, const BodyHit& hit, const Vec3& local_direction);

/** Axis-aligned box. */
struct Bounds
{
  Vec3 min = Vec3::Constant(1e300);
  Vec3 max = Vec3::Constant(-1e300);

  void include(const Bounds& other);
  [[nodiscard]] Vec3 center() const { return 0.5 * (min + max); }
};

/** The smallest box around the primitive, or a little larger. */
[[nodiscard]] Bounds boundsOf(const Primitive& primitive);

}  // namespace fastlio
