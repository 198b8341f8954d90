// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_counts.h Everything that was read or dropped, as named numbers. */
#pragma once

#include <fastlio/odometry/odometry.h>
#include <fastlio/run/run_summary.h>
#include <fastlio/sensors/observation_bridge.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Counts of the bridge, then those of the odometry's input. */
[[nodiscard]] std::vector<NamedCount> inputCounts(
    const BridgeStatistics& bridge, const InputStatistics& odometry);

/** Points of LiDARs beside the first one that no scan has taken in, where they are a considerable
 * part. */
[[nodiscard]] std::optional<std::string> leftOutText(const BridgeStatistics& bridge);

/** Why there is no result for the scans after the last one, as far as the counts show it. */
[[nodiscard]] std::string lostEndText(const InputStatistics& odometry);

}  // namespace fastlio
