// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file config.h Everything that a run is configured with, and the table of its keys. */
#pragma once

#include <fastlio/exporters/export_options.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/options/option_table.h>
#include <fastlio/sensors/sensor_options.h>

namespace fastlio
{
/** The options of all consumers. */
struct Config
{
  SensorOptions sensors;     //!< for whoever feeds the odometry
  OdometryOptions odometry;  //!< for the odometry itself
  ExportOptions exporters;   //!< for whoever writes files
};

/** All keys, those of a group side by side. */
[[nodiscard]] const OptionTable<Config>& configTable();

/** Checks the ranges and the relations of options that were set in code.
 * \exception std::invalid_argument lists every problem */
void validate(const Config& config);

}  // namespace fastlio
