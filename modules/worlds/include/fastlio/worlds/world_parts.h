// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file world_parts.h Things that worlds are made of. All lengths in metres, full sizes, z up. */
#pragma once

#include <fastlio/worlds/world.h>

#include <random>

namespace fastlio
{
/** Uniform numbers in [low, high), the same on every platform. */
class Draws
{
 public:
  explicit Draws(unsigned seed) : engine_(seed) {}

  [[nodiscard]] double operator()(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  [[nodiscard]] bool chance(double probability) { return (*this)(0.0, 1.0) < probability; }
  /** 0 to count - 1. */
  [[nodiscard]] int below(int count) { return static_cast<int>((*this)(0.0, count)); }

 private:
  std::mt19937 engine_;
};

using Bodies = std::vector<Primitive>;

/** A box that stands on z = base. */
struct BoxOnGround
{
  double x, y;                   //!< centre
  double length, width, height;  //!< along its own x, y and z
  double base = 0.0;
  double yaw = 0.0;  //!< [rad]
  double reflectivity = 0.4;
};
[[nodiscard]] Primitive box(const BoxOnGround& b);

/** An upright cylinder from z = base. */
[[nodiscard]] Primitive pillar(
    double x, double y, double radius, double height, double base = 0.0, double reflectivity = 0.4);

[[nodiscard]] Primitive ball(const Vec3& center, double radius, double reflectivity = 0.3);

/** A horizontal rectangle: floor or ceiling. */
[[nodiscard]] Primitive slab(
    double min_x, double min_y, double max_x, double max_y, double z, double reflectivity = 0.3);

/** A box seen from inside and outside: room, hall, tunnel. */
[[nodiscard]] Primitive shell(const Vec3& min, const Vec3& max, double reflectivity = 0.5);

/** An opening in a wall. */
struct Door
{
  double at;  //!< centre along the wall
  double width = 1.2;
  double height = 2.1;
};

/** A wall along x (or y) from begin to end at the given y (or x), with doors; appended to bodies.
 */
struct WallSpec
{
  bool along_x;
  double begin, end, at;
  double height;
  double thickness = 0.15;
};
void appendWall(Bodies& bodies, const WallSpec& wall, const std::vector<Door>& doors = {});

/** Trunk and crown. */
void appendTree(Bodies& bodies, double x, double y, double base, double height);

/** A building with window bays that stand out from its fronts and a ledge below the roof. */
void appendBuilding(Bodies& bodies, const BoxOnGround& block);

/** A parked car: body and cabin. */
void appendCar(Bodies& bodies, double x, double y, double base, double yaw);

/** Desk, cabinet and shelf sized boxes at reproducible places inside of the rectangle, never within
 * 0.9 m of the given points. */
struct FurnitureArea
{
  double min_x, min_y, max_x, max_y;
  int pieces;
  unsigned seed;
  std::vector<Vec3> keep_free;
};
void appendFurniture(Bodies& bodies, const FurnitureArea& area);

}  // namespace fastlio
