// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_check.h Whether a value is one that its row allows. */
#pragma once

#include <fastlio/odometry/parameter_table.h>

#include <optional>
#include <string>

namespace fastlio
{
/** What is wrong with the value that \a parameters hold, or nothing. */
[[nodiscard]] std::optional<std::string> valueProblem(
    const ParameterRow& row, const Parameters& parameters);

}  // namespace fastlio
