// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file export_options.h Which files are written, and how. */
#pragma once

#include <string>

namespace fastlio
{
/** How an odometry rawlog is built. */
enum class RawlogForm
{
  Observations,  //!< single observations in order of time
  Actions        //!< pairs of actions (motion) and sensory frames
};

/** Group `output`. */
struct ExportOptions
{
  std::string exporters;           //!< names, separated by commas; empty: the standard ones
  double tile_size = 50.0;         //!< edge of the pieces that a map is kept in [m]
  double map_memory = 5.0;         //!< so many points of the map stay in memory [million]
  double submap_memory = 5.0;      //!< so many planes of submaps stay in memory [million]
  double keyframe_distance = 1.0;  //!< a keyframe after so much travel [m]
  double keyframe_angle = 0.3490658503988659;  //!< or so much rotation [rad] (YAML: deg)
  RawlogForm rawlog_form = RawlogForm::Observations;
  bool rawlog_pass_through = true;  //!< also the input's observations
  bool rawlog_scan_2d = true;       //!< also a pseudo-2D scan
  int scan_2d_rays = 720;           //!< of the pseudo-2D scan
  double scan_2d_height = 0.0;      //!< of its plane above the LiDAR [m]
  double scan_2d_thickness = 0.2;   //!< of the slice that it is cut from [m]
};

}  // namespace fastlio
