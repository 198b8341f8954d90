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
/** Options of pseudo2dScan(). */
struct Pseudo2dScanOptions
{
  int rays = 720;
  double height = 0.0;       //!< of the plane above the LiDAR [m]
  double thickness = 0.2;    //!< of the slice around the plane [m]
  double max_range = 150.0;  //!< [m]
};

/** As the options of the exporters ask for it.
 * \param max_range of the LiDAR (lidar.max_range) [m] */
[[nodiscard]] Pseudo2dScanOptions planarScanOptions(const ExportOptions& options, double max_range);

/** The scan as a planar LiDAR in a level plane through the real one would have seen it at the
 * scan's stamp: each point moves to where it was in the world when it was measured, and the nearest
 * one in each ray of the slice counts. The vehicle of the result is the level frame on the ground
 * below the body (x, y and yaw of its pose). Null when the track has no pose for the scan's stamp.
 */
[[nodiscard]] mrpt::obs::CObservation2DRangeScan::Ptr pseudo2dScan(
    const LidarScan& scan, const PoseTrack& track, const Pseudo2dScanOptions& options);

}  // namespace fastlio
