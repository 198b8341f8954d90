// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file world.h The world around the LiDAR: bodies at rest, ground and moving objects. */
#pragma once

#include <fastlio/worlds/box_tree.h>
#include <fastlio/worlds/boxed_bodies.h>
#include <fastlio/worlds/height_field.h>
#include <fastlio/worlds/ray_bundle.h>

#include <vector>

namespace fastlio
{
/** A body that swings to and fro: its centre is at p + amplitude sin(w t + phase). */
struct MovingObject
{
  Primitive body;                  //!< at the centre of its path
  Vec3 amplitude = Vec3::Zero();   //!< [m]
  double angular_frequency = 0.0;  //!< w [rad/s]
  double phase = 0.0;              //!< [rad]

  /** Where its centre is at t [s]. */
  [[nodiscard]] Vec3 positionAt(double t) const;
  /** The body where it is at t [s]. */
  [[nodiscard]] Primitive at(double t) const;
};

/** The parts of a world. */
struct WorldDescription
{
  std::vector<Primitive> bodies;
  std::vector<MovingObject> moving;
  std::optional<HeightField> ground;
};

/** A world to cast rays into; immutable, usable from many threads at once. */
class World
{
 public:
  explicit World(WorldDescription description);

  /** The nearest surface within max_range [m] along the ray at t [s].
   * \param near more bodies, which stand in front of what they touch */
  [[nodiscard]] std::optional<RayHit> cast(
      const Ray& ray, double t, double max_range, const BoxedBodies& near = {}) const;

  /** The same for each ray of a bundle, in a fraction of the time. */
  [[nodiscard]] BundleHits cast(
      const RayBundle& rays, double t, double max_range, const BoxedBodies& near = {}) const;

  [[nodiscard]] const WorldDescription& description() const { return description_; }

 private:
  void trace(TracedBundle& rays, double t, const BoxedBodies& near) const;

  WorldDescription description_;
  BoxTree tree_;   //!< of the bodies
  BoxList swept_;  //!< where the moving objects can be
};

}  // namespace fastlio
