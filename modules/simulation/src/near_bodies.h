// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file near_bodies.h People close to the sensors (internal). */
#pragma once

#include <fastlio/scenarios/settings.h>
#include <fastlio/worlds/boxed_bodies.h>

namespace fastlio
{
/** Replaces the bodies by the person who carries the sensors, and people who walk along with them,
 * at t [s]: the carrier moves with the IMU, the others with its position only. */
void placeNearBodies(
    BoxedBodies& bodies, const CarrierSettings& settings, double t, const Pose& T_world_imu);

}  // namespace fastlio
