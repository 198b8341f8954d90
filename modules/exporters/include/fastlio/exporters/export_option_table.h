// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file export_option_table.h Key, unit, range and effect of each member of ExportOptions. */
#pragma once

#include <fastlio/exporters/export_options.h>
#include <fastlio/options/option_table.h>

namespace fastlio
{
[[nodiscard]] const OptionTable<ExportOptions>& exportOptionTable();

}  // namespace fastlio
