// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_option_table.h Key, unit, range and effect of the options of the estimator. */
#pragma once

#include <fastlio/interface/odometry_options.h>
#include <fastlio/options/option_table.h>

#include <string>
#include <vector>

namespace fastlio
{
[[nodiscard]] const OptionTable<OdometryOptions>& odometryOptionTable();

/** The errors in \a options, ranges and relations, each with its key; empty: nothing. */
[[nodiscard]] std::vector<std::string> optionProblems(const OdometryOptions& options);

/** The guard of options that were set in code.
 * \exception std::invalid_argument lists every problem */
void validate(const OdometryOptions& options);

}  // namespace fastlio
