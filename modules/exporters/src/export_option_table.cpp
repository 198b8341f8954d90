// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/export_option_table.h>
#include <fastlio/math/angles.h>

namespace fastlio
{
namespace
{
using Rows = OptionTable<ExportOptions>;

/** Which files, and the form of the rawlog. */
Rows fileRows()
{
  return {
      {"output.exporters", "",
       [](auto& o) -> OptionValue {
         return TextValue{&o.exporters, "names separated by commas"};
       },
       "which files are written: names of docs/outputs.md, separated by commas; empty: the "
       "standard ones",
       OptionTier::Main},
      {"output.rawlog_form", "", choice(&ExportOptions::rawlog_form, {"observations", "actions"}),
       "odometry.rawlog: single observations in order of time, or pairs of an action (the motion) "
       "and a sensory frame, as rbpf-slam and graphslam-engine take them"},
      {"output.rawlog_pass_through", "", valueAs<BooleanValue>(&ExportOptions::rawlog_pass_through),
       "odometry.rawlog: also holds the observations of the input"},
      {"output.rawlog_scan_2d", "", valueAs<BooleanValue>(&ExportOptions::rawlog_scan_2d),
       "odometry.rawlog: also holds a planar scan, cut from each LiDAR scan in a plane that is "
       "level whatever the attitude, for 2D SLAM"},
      {"output.scan_2d_rays", "", wholeNumber(&ExportOptions::scan_2d_rays, 8, 36000),
       "rays of the planar scan, all around"},
      {"output.scan_2d_height", "m", number(&ExportOptions::scan_2d_height, -100.0, 100.0),
       "height of the planar scan above the LiDAR"},
      {"output.scan_2d_thickness", "m", number(&ExportOptions::scan_2d_thickness, 0.01, 10.0),
       "thickness of the slice that the planar scan is made of; the nearest point in a ray counts"},
  };
}

/** Maps and keyframes. */
Rows mapRows()
{
  return {
      {"output.tile_size", "m", number(&ExportOptions::tile_size, 1.0, 1e4),
       "edge of the tiles of the saved map"},
      {"output.map_memory", "million", number(&ExportOptions::map_memory, 0.01, 1e4),
       "number of points of the saved map that stay in memory; beyond it, the least recently used "
       "tiles go to files in the output folder"},
      {"output.submap_memory", "million", number(&ExportOptions::submap_memory, 0.001, 1e4),
       "fastlio-map: number of planes of submaps that stay in memory (68 bytes each); beyond it, "
       "the least recently used submaps go to files in the output folder"},
      {"output.keyframe_distance", "m", number(&ExportOptions::keyframe_distance, 0.01, 1e4),
       "keyframes (simplemap, pose graph): largest distance from one to the next"},
      {"output.keyframe_angle", "deg",
       number(&ExportOptions::keyframe_angle, 0.1, 180.0, kRadPerDeg),
       "keyframes: largest rotation from one to the next"},
  };
}
}  // namespace

const OptionTable<ExportOptions>& exportOptionTable()
{
  static const Rows table = joinedRows<ExportOptions>({fileRows(), mapRows()});
  return table;
}

}  // namespace fastlio
