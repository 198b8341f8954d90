// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_options.h Options of the scans: gates, downsampling, features. */
#pragma once

#include <fastlio/lidar/feature_lines.h>

#include <vector>

namespace fastlio
{
/** Group `lidar`. */
struct LidarOptions
{
  double min_range = 0.5;    //!< nearer points are dropped [m]
  double max_range = 150.0;  //!< farther points are dropped [m]
  /** Scans wait so long for inertial data, in the LiDAR's time [s]. No key: tests shorten it, as
   * their recordings are shorter. */
  double max_waiting = 10.0;
  double time_offset = 0.0;  //!< added to the LiDAR stamps [s]
  bool deskew = true;        //!< motion compensation (eq. 9-10)
  /** Rows of elevation [deg], offset of the range [m] and of the elevation [deg] (YAML's units). */
  std::vector<double> beam_offsets;
};

/** Group `downsampling`. */
struct DownsamplingOptions
{
  int target_points = 1500;  //!< about so many points of a scan are used; 0 = all
  int wide_points = 3000;    //!< of scans that reach far, not more than so many
};

/** Which points of a scan are measurements. */
enum class FeatureMode
{
  None,          //!< direct: any point that finds a plane
  Planar,        //!< planar features
  PlanarAndEdge  //!< planar features, and edge features on lines (paper)
};

/** Group `features`. */
struct FeatureOptions
{
  FeatureMode mode = FeatureMode::None;
  ScanLineOrder scan_lines = ScanLineOrder::Automatic;  //!< what makes points neighbours
  double half_width = 0.25;                   //!< neighbours reach so far to each side [m]
  double max_beam_gap = 0.03490658503988659;  //!< between neighbours [rad] (YAML: deg)
};

}  // namespace fastlio
