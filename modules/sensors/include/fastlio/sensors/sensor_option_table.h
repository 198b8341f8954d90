// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sensor_option_table.h Key, unit, range and effect of each member of SensorOptions. */
#pragma once

#include <fastlio/options/option_table.h>
#include <fastlio/sensors/sensor_options.h>

namespace fastlio
{
[[nodiscard]] const OptionTable<SensorOptions>& sensorOptionTable();

}  // namespace fastlio
