// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file random_bodies.h Bodies and rays of all kinds at random places. */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <random>

namespace fastlio
{
class Dice
{
 public:
  double operator()(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 point(double half)
  {
    const double x = (*this)(-half, half), y = (*this)(-half, half), z = (*this)(-half, half);
    return {x, y, z};
  }
  Vec3 direction() { return point(1.0).normalized(); }

 private:
  std::mt19937_64 engine_{7};
};

inline Primitive randomPrimitive(Dice& dice, double spread)
{
  Primitive p;
  p.shape = static_cast<Primitive::Shape>(static_cast<int>(dice(0.0, 3.999)));
  p.T_world_local = {expSO3(dice.point(2.0)), dice.point(spread)};
  p.size = Vec3(dice(0.2, 2.0), dice(0.2, 2.0), dice(0.2, 2.0));
  return p;
}
}  // namespace fastlio
