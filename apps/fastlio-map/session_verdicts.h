// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file session_verdicts.h The verdict on each session, for people and as an exit status. */
#pragma once

#include <fastlio/mapping/map_builder.h>
#include <fastlio/run/run_summary.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Whether the place of a session in the map was found. */
[[nodiscard]] bool isInMap(const BuiltMap& map, std::size_t session);

/** The status of the session that fared worst, by the order of fastlio-replay. */
[[nodiscard]] ExitStatus statusOf(
    const BuiltMap& map, const std::vector<std::string>& output_problems);

/** Diagnostics for people. */
[[nodiscard]] std::vector<std::string> notesOf(
    const std::vector<Session>& sessions, const BuiltMap& map);

}  // namespace fastlio
