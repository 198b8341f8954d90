// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_options.h Options of the scans: gates, downsampling, features. */
#pragma once

#include <fastlio/lidar/feature_lines.h>

namespace fastlio
{
/** Group `lidar`. */
struct LidarOptions
{
  double min_range = 0.5;     //!< nearer points are dropped [m]
  double max_range = 150.0;   //!< farther points are dropped [m]
  double max_waiting = 10.0;  //!< scans wait so long for inertial data, in the LiDAR's time [s]
  double time_offset = 0.0;   //!< added to the LiDAR stamps [s]
  bool deskew = true;         //!< motion compensation (eq. 9-10)
};

/** Group `downsampling`. */
struct DownsamplingOptions
{
  int target_points = 1500;  //!< about so many points of a scan are used; 0 = all
  double wide_range = 20.0;  //!< RMS range beyond which more points are used [m]
  int wide_points = 3000;    //!< but not more than so many
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
  int min_neighbors = 3;                      //!< at least so many on each side
  double max_planar_smoothness = 0.2;         //!< planar below
  double min_edge_smoothness = 0.4;           //!< edge above
  double min_incidence = 0.3490658503988659;  //!< between surface and beam [rad] (YAML: deg)
  double max_beam_turn = 0.1;                 //!< largest smoothness of the line of unit beams
  double max_beam_gap = 0.03490658503988659;  //!< between neighbours [rad] (YAML: deg)
  double max_spacing = 1.0;                   //!< between neighbours [m]
  double range_jump = 0.1;                    //!< between neighbours, beyond min_incidence [m]
  int target_edges = 300;                     //!< about so many edge points are used; 0 = all
  double edge_spacing = 0.2;       //!< nearer points are not added to the map of edges [m]
  double max_edge_distance = 2.0;  //!< farthest neighbour on a line [m]
  double max_edge_scatter = 0.15;  //!< farthest neighbour from the line [m]
};

}  // namespace fastlio
