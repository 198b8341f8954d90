// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_report.h The end of a run, for people. */
#pragma once

#include <fastlio/run/run_summary.h>

#include <string>

namespace fastlio
{
/** A table of what was processed, how fast, what was lost, which files there are and the status. */
[[nodiscard]] std::string reportText(const RunSummary& summary);

/** Diagnostics beside the table: one sentence each, the cause of a non-zero exit
 * status among them. */
[[nodiscard]] std::vector<std::string> troubleSentences(const RunSummary& summary);

}  // namespace fastlio
