// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_bytes.h The points of map.ply and map.pcd: x, y, z, intensity as float, time as
 * double, little-endian. Where the map has an origin, x, y and z are double, too. */
#pragma once

#include <fastlio/exporters/output_map.h>
#include <fastlio/files/atomic_file.h>

namespace fastlio
{
/** Writes all points of the map, tile by tile.
 * \exception std::runtime_error the disk refused */
void writePoints(const OutputMap& map, AtomicFile& file);

}  // namespace fastlio
