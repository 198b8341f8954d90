// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_text.h Single parameter values as text, and what a row says about itself. */
#pragma once

#include <fastlio/odometry/parameter_table.h>

#include <string>

namespace fastlio
{
/** The value in YAML notation and in the unit of the file. */
[[nodiscard]] std::string valueText(const ParameterRow& row, const Parameters& parameters);

/** What may stand in the file: "0.5 to 10 m", "true or false", "information, standard", ... */
[[nodiscard]] std::string allowedText(const ParameterRow& row);

/** Short name of the type: "number", "integer", "boolean", ... */
[[nodiscard]] std::string typeText(const ParameterRow& row);

}  // namespace fastlio
