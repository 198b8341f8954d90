// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ply_file.h Coordinates out of PLY files. */
#pragma once

#include "file_points.h"

#include <string>

namespace fastlio
{
/** The properties x, y, z of the vertices of a PLY file (1.0, ascii, binary_little_endian or
 * binary_big_endian); other elements and properties are skipped. MRPT's own reader takes what is
 * missing at the end for points, with a line on standard error for each.
 * \exception std::runtime_error the file is damaged or of another form */
[[nodiscard]] FilePoints readPly(const std::string& path);

}  // namespace fastlio
