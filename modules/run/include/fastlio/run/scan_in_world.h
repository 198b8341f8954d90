// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_in_world.h The points of a scan where they were when they were measured. */
#pragma once

#include <fastlio/lidar/scan.h>
#include <fastlio/run/output_map.h>
#include <fastlio/run/pose_track.h>

namespace fastlio
{
/** Every point of the scan with the pose of its own time; those without a pose are left out.
 * \param track of the vehicle, or any other body, named by its frame
 * \param origin what the points are counted from, in the world [m]: in single precision, they had
 * better be near it */
[[nodiscard]] OutputPoints scanInWorld(
    const LidarScan& scan, const PoseTrack& track, const Vec3& origin = Vec3::Zero());

/** The LiDAR's mounting on the track's body. */
[[nodiscard]] Pose mountingOn(const PoseTrack& track, const LidarScan& scan);

}  // namespace fastlio
