// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_account.h What the program tells about a map that it has made. */
#pragma once

#include "command_line.h"
#include "map_outputs.h"
#include <fastlio/mapping/map_report.h>
#include <fastlio/submaps/submap_store.h>

#include <string>
#include <vector>

namespace fastlio
{
/** The account of a map whose points and poses are written. \param store of its submaps: surfaces
 * that it has lost make the map worse than it could be, and so are a problem */
[[nodiscard]] MapAccount accountOf(
    const MapArguments& arguments, const std::vector<std::string>& recordings,
    const std::vector<Session>& sessions, const BuiltMap& map, const MapOutputs& outputs,
    const SubmapStore& store);

}  // namespace fastlio
