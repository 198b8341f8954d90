// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_option_rows.h The rows of odometryOptionTable(), by groups (internal). */
#pragma once

#include <fastlio/interface/odometry_option_table.h>

namespace fastlio
{
using OdometryOptionRows = OptionTable<OdometryOptions>;

// Defined in odometry_option_rows_inputs.cpp.
[[nodiscard]] OdometryOptionRows inputRows();

// Defined in odometry_option_rows_estimation.cpp.
[[nodiscard]] OdometryOptionRows estimationRows();

}  // namespace fastlio
