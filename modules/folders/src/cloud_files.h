// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cloud_files.h Files that hold one cloud each. */
#pragma once

#include <fastlio/sensors/xyzirt_access.h>

#include <string>

namespace fastlio
{
/** KITTI's: four 32-bit numbers a point, x y z [m] and reflectance.
 * \exception std::runtime_error it cannot be read, or its size is not that of whole points */
[[nodiscard]] CloudColumns readBinCloud(const std::string& path);

/** PCD, ASCII, binary or compressed, with any fields.
 * \exception std::runtime_error it cannot be read, or is not what its head says */
[[nodiscard]] CloudColumns readPcdCloud(const std::string& path);

}  // namespace fastlio
