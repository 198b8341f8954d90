// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file path_builder.h Smooth closed paths from a few corner points. */
#pragma once

#include <fastlio/worlds/motion.h>

#include <functional>
#include <vector>

namespace fastlio
{
/** Where a walker, vehicle or drone shall go. */
struct Route
{
  std::vector<Vec3> corners;  //!< closed polyline [m]; z above the ground
  double speed = 1.0;         //!< along the path, the greatest one [m/s]
  double corner_cut = 1.0;    //!< the path is averaged over this length, which rounds corners [m]
  double acceleration = 0.0;  //!< greatest one along and across the path; 0: constant speed [m/s^2]
  std::function<double(double x, double y)> ground;  //!< height [m]; none: 0
};

/** A path along the route, at constant speed or slower in bends, level, with the yaw along the
 * path.
 * \exception std::invalid_argument fewer than two corners, or a length or speed not positive
 */
[[nodiscard]] CarrierPath followRoute(const Route& route);

/** Adds an oscillation to a channel. The frequency [Hz] is moved to the nearest one with whole
 * periods per loop, so that the loop closes. */
void addOscillation(
    CarrierPath& path, CarrierPath::Channel channel, double amplitude, double frequency);

/** The motion of a walking person's hands: up and down with each step, sideways with every other
 * one, and some swing in attitude. \param strength factor on all amplitudes */
void addWalkingSway(CarrierPath& path, double step_frequency, double strength = 1.0);

/** Tilts a vehicle as the ground below it: pitch and roll by the slope along and across the yaw. */
void addGroundTilt(CarrierPath& path, const std::function<double(double x, double y)>& ground);

/** Tilts the carrier as a multirotor must to fly the path: its z axis along the thrust. */
void addThrustTilt(CarrierPath& path, double gravity);

/** Length of the path over one loop [m]. */
[[nodiscard]] double loopLength(const CarrierPath& path);

}  // namespace fastlio
