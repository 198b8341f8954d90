// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pcd_file.h Coordinates out of PCD files. */
#pragma once

#include "file_points.h"

#include <string>

namespace fastlio
{
/** The fields x, y, z of a PCD file, in double precision where it has it.
 * \exception std::runtime_error the file is damaged or of another form */
[[nodiscard]] FilePoints readPcd(const std::string& path);

}  // namespace fastlio
