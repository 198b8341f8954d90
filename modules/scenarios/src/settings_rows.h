// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file settings_rows.h Rows of settingsTable() that stand in files of their own (internal). */
#pragma once

#include <fastlio/scenarios/settings_table.h>

#include <vector>

namespace fastlio
{
// Defined in settings_rows_aids.cpp: sensors beside LiDAR and IMU.
[[nodiscard]] OptionTable<SimulationSettings> aidRows();

// Defined in settings_rows_imperfections.cpp: all that realistic() turns on.
[[nodiscard]] OptionTable<SimulationSettings> imperfectionRows();

}  // namespace fastlio
