// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pseudo_2d_scan.h A planar scan out of a 3D one, for 2D SLAM. */
#pragma once

#include <fastlio/exporters/export_options.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/run/pose_track.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

namespace fastlio
{
/** The scan as a planar LiDAR in a level plane through the real one would have seen it at the
 * scan's stamp: each point moves to where it was in the world when it was measured, and the nearest
 * one in each ray of the slice counts. The vehicle of the result is the level frame on the ground
 * below the body (x, y and yaw of its pose). Null when the track has no pose for the scan's stamp.
 * \param options rays, and height and thickness of the slice
 * \param max_range of the LiDAR (lidar.max_range) [m] */
[[nodiscard]] mrpt::obs::CObservation2DRangeScan::Ptr pseudo2dScan(
    const LidarScan& scan, const PoseTrack& track, const ExportOptions& options, double max_range);

}  // namespace fastlio
