// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file town_parts.h Houses and streets (internal). */
#pragma once

#include <fastlio/scenarios/scenes.h>
#include <fastlio/worlds/world_parts.h>

#include <functional>

namespace fastlio
{
/** Height of the ground [m]. */
using GroundHeight = std::function<double(double x, double y)>;

/** A house whose front is its side at +y. */
struct House
{
  double x, y;                  //!< centre [m]
  double yaw;                   //!< [rad]
  double width, depth, height;  //!< along its own x, y and z [m]
  double base;                  //!< height of the street in front of it [m]
};

/** A house with a front drawn from many: bays, balconies, pilasters or frames of windows, and
 * porch, plinth, cornice and gable. */
void appendHouse(Bodies& bodies, const House& house, Draws& draw);

/** A straight street between two crossings. */
struct Street
{
  Vec3 from, to;  //!< middle of the crossings [m]
  unsigned seed;  //!< of what stands there
};

/** Half widths of a street [m]: of what lies between parked cars, to trees, to houses. */
struct StreetWidths
{
  static constexpr double kParked = 4.5, kTrees = 6.3, kHouses = 7.5;
  static constexpr double kCrossing = 13.0;  //!< houses begin so far from a crossing's middle
};

/** Houses of different fronts on both sides, gaps between some of them, parked cars, trees, poles
 * and bins. */
void appendStreet(Scene& scene, const Street& street, const GroundHeight& ground);

}  // namespace fastlio
