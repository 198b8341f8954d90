// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file wheel_model.h Odometry of two driven wheels. */
#pragma once

#include <fastlio/scenarios/settings.h>
#include <fastlio/worlds/motion.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Where the wheels believe the vehicle to be: its frame (that of the IMU) in the plane in which it
 * started, x ahead. */
struct WheelReading
{
  std::int64_t stamp_ns = 0;
  double x = 0.0, y = 0.0;  //!< [m]
  double heading = 0.0;     //!< [rad], not wrapped
  double speed = 0.0;       //!< ahead, mean since the last reading [m/s]
  double turn_rate = 0.0;   //!< to the left, mean since the last reading [rad/s]
};

/** The readings of a recording in the order of time, from its start on; none without a rate.
 *
 * Each wheel rolls by the way along the vehicle's x axis, less or more half of the turn; it
 * measures (1 + scale_error) times that, plus noise * sqrt(way). The vehicle does not slide
 * sideways.
 *
 * \param settings with a duration that is not zero */
[[nodiscard]] std::vector<WheelReading> simulateWheels(
    const Motion& motion, const SimulationSettings& settings);

}  // namespace fastlio
