// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "near_bodies.h"

#include <fastlio/math/angles.h>

#include <cmath>

namespace fastlio
{
namespace
{
Primitive upright(const Pose& T, const Vec3& center, double radius, double half_height)
{
  return {Primitive::Shape::Cylinder, {T.R, T * center}, {radius, radius, half_height}, 0.4};
}

/** The trunk of a person who holds the sensors in front of the chest, and the head above. */
void addCarrier(BoxedBodies& bodies, const Pose& T_world_imu)
{
  bodies.add(upright(T_world_imu, {-0.65, 0.0, -0.55}, 0.2, 0.7));
  bodies.add(
      {Primitive::Shape::Sphere,
       {Mat3::Identity(), T_world_imu * Vec3(-0.62, 0.0, 0.3)},
       Vec3::Constant(0.12),
       0.5});
}

/** Number i of a crowd: all around, 0.7 to 1.5 m away, swaying along and across. */
Primitive companion(int i, int count, double t, const Vec3& imu)
{
  const double around = kTwoPi * i / count + 0.5 * std::sin(0.31 * t + 1.7 * i);
  const double away = 1.1 + 0.15 * (i % 3) + 0.1 * std::sin(0.9 * t + 2.3 * i);
  const Vec3 center(away * std::cos(around), away * std::sin(around), -0.55);
  return upright({Mat3::Identity(), imu}, center, 0.22, 0.9);
}
}  // namespace

void placeNearBodies(
    BoxedBodies& bodies, const CarrierSettings& settings, double t, const Pose& T_world_imu)
{
  bodies.clear();
  if (settings.body) addCarrier(bodies, T_world_imu);
  for (int i = 0; i < settings.crowd; ++i)
    bodies.add(companion(i, settings.crowd, t, T_world_imu.p));
}

}  // namespace fastlio
