// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file saved_map_file.h Maps of earlier runs out of files. */
#pragma once

#include <fastlio/localmap/saved_map.h>

#include <string>

namespace fastlio
{
/** Reads a map to start in; its content decides what it is, not its name:
 *
 * - PLY (ASCII or binary), PCD (ASCII, binary or compressed): the points,
 * - an archive of MRPT, gzip or not: points maps of any class, fastlio::CVoxelPlanesMap (its planes
 *   are taken as they are), CMultiMetricMap (its first map that has points).
 *
 * The start is the map's origin.
 * \exception std::runtime_error the file cannot be read, is something else, or has no points */
[[nodiscard]] SavedMap loadSavedMap(const std::string& path);

}  // namespace fastlio
