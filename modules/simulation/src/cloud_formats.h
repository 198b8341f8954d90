// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cloud_formats.h Point clouds as different drivers write them (internal). */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/scenarios/settings.h>

#include <mrpt/maps/CPointsMap.h>

#include <cstdint>

namespace fastlio
{
/** From the first shot to the instant that the scan's stamp is about [ns]. */
[[nodiscard]] std::int64_t stampShiftOf(const LidarSettings& lidar);

/** In class, unit and zero of the times as the settings say.
 * \param points with times from the first shot
 * \param first_shot_ns its stamp */
[[nodiscard]] mrpt::maps::CPointsMap::Ptr encodeCloud(
    const PointColumns& points, std::int64_t first_shot_ns, const LidarSettings& lidar);

}  // namespace fastlio
