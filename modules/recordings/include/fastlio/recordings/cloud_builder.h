// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cloud_builder.h Columns of a recorded cloud as an observation. */
#pragma once

#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/obs/CObservationPointCloud.h>

#include <cstdint>
#include <string>

namespace fastlio
{
/** The columns as a CGenericPointsMap, whose times are in 64 bits unless they were recorded in 32.
 * \pre each column is empty or as long as x */
[[nodiscard]] mrpt::obs::CObservationPointCloud::Ptr makeCloud(
    const CloudColumns& columns, const std::string& label, std::int64_t stamp_ns);

}  // namespace fastlio
