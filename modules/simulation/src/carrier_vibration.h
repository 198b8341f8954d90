// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file carrier_vibration.h Vibration of the platform (internal). */
#pragma once

#include <fastlio/scenarios/settings.h>
#include <fastlio/worlds/motion.h>

namespace fastlio
{
/** Makes all six coordinates vibrate while the platform moves, with tones spread from 20 to 200 Hz:
 * some micrometres of travel, as exact as the rest of the motion. The seed draws the tones. */
void addVibration(CarrierPath& path, const SimulationSettings& settings);

}  // namespace fastlio
