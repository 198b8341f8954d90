// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
ParameterRows rawlogRows()
{
  return {
      {"output.rawlog_form", "",
       enumeration([](auto& p) { return &p.output.rawlog_form; }, {"observations", "actions"}),
       "odometry.rawlog: single observations in order of time, or pairs of an action (the motion) "
       "and a sensory frame, as rbpf-slam and graphslam-engine take them"},
      {"output.rawlog_pass_through", "",
       BooleanValue{[](auto& p) { return &p.output.rawlog_pass_through; }},
       "odometry.rawlog: also holds the observations of the input"},
      {"output.rawlog_scan_2d", "", BooleanValue{[](auto& p) { return &p.output.rawlog_scan_2d; }},
       "odometry.rawlog: also holds a planar scan, cut from each LiDAR scan in a plane that is "
       "level whatever the attitude, for 2D SLAM"},
      {"output.scan_2d_rays", "",
       IntegerValue{[](auto& p) { return &p.output.scan_2d_rays; }, 8, 36000},
       "rays of the planar scan, all around"},
      {"output.scan_2d_height", "m",
       RealValue{[](auto& p) { return &p.output.scan_2d_height; }, -100.0, 100.0},
       "height of the planar scan above the LiDAR"},
      {"output.scan_2d_thickness", "m",
       RealValue{[](auto& p) { return &p.output.scan_2d_thickness; }, 0.01, 10.0},
       "thickness of the slice that the planar scan is made of; the nearest point in a ray counts"},
  };
}
}  // namespace

ParameterRows outputRows()
{
  ParameterRows rows = {
      {"output.imu_rate", "", BooleanValue{[](auto& p) { return &p.output.imu_rate; }},
       "true: also gives the state at each inertial sample, predicted from the latest scan before "
       "it (imu_rate.csv)"},
      {"output.exporters", "",
       TextValue{[](auto& p) { return &p.output.exporters; }, "names separated by commas"},
       "which files are written: names of docs/outputs.md, separated by commas; empty: the "
       "standard ones"},
      {"output.tile_size", "m", RealValue{[](auto& p) { return &p.output.tile_size; }, 1.0, 1e4},
       "the map that is saved is kept in pieces of this size"},
      {"output.map_memory", "million",
       RealValue{[](auto& p) { return &p.output.map_memory; }, 0.01, 1e4},
       "so many points of the map that is saved stay in memory; beyond it, the pieces that were "
       "not added to for longest go to files in the output folder"},
      {"output.keyframe_distance", "m",
       RealValue{[](auto& p) { return &p.output.keyframe_distance; }, 0.01, 1e4},
       "key frames (simplemap, pose graph): the next one after so much travel"},
      {"output.keyframe_angle", "deg",
       RealValue{[](auto& p) { return &p.output.keyframe_angle; }, 0.1, 180.0, kRadPerDeg},
       "key frames: or after so much rotation"},
  };
  for (auto& row : rawlogRows())
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace fastlio
