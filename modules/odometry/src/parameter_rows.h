// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_rows.h The rows of parameterTable(), group by group (internal). */
#pragma once

#include <fastlio/odometry/parameter_table.h>

#include <vector>

namespace fastlio
{
using ParameterRows = std::vector<ParameterRow>;

// Defined in parameter_rows_input.cpp.
[[nodiscard]] ParameterRows inputRows();
[[nodiscard]] ParameterRows furtherLidarRows();

// Defined in parameter_rows_sensors.cpp.
[[nodiscard]] ParameterRows initializationRows();
[[nodiscard]] ParameterRows motionStartRows();
[[nodiscard]] ParameterRows imuRows();
[[nodiscard]] ParameterRows lidarRows();
[[nodiscard]] ParameterRows calibrationRows();

// Defined in parameter_rows_faults.cpp.
[[nodiscard]] ParameterRows imuFaultRows();
[[nodiscard]] ParameterRows healthRows();
[[nodiscard]] ParameterRows recoveryRows();

// Defined in parameter_rows_features.cpp.
[[nodiscard]] ParameterRows featureRows();

// Defined in parameter_rows_estimation.cpp.
[[nodiscard]] ParameterRows downsamplingRows();
[[nodiscard]] ParameterRows measurementRows();
[[nodiscard]] ParameterRows mapRows();
[[nodiscard]] ParameterRows updateRows();

// Defined in parameter_rows_rest.cpp.
[[nodiscard]] ParameterRows restRows();

// Defined in parameter_rows_map_start.cpp.
[[nodiscard]] ParameterRows mapStartRows();

// Defined in parameter_rows_output.cpp.
[[nodiscard]] ParameterRows outputRows();

// Defined in parameter_rows_estimation.cpp.
[[nodiscard]] ParameterRows generalRows();

}  // namespace fastlio
