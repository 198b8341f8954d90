// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file edge_stage.h What edge points add to the update of a scan (section III-B of the paper). */
#pragma once

#include <fastlio/lidar/deskew.h>
#include <fastlio/map/edge_map.h>
#include <fastlio/odometry/parameters.h>
#include <fastlio/odometry/point_to_line.h>

#include <vector>

namespace fastlio
{
/** The edge points of scans: their map, their matches, their part of the measurements. */
class EdgeStage
{
 public:
  explicit EdgeStage(const Parameters& parameters);

  /** The scan's edge points at its end; to be filled before the functions below are called. */
  [[nodiscard]] BodyPoints& points() { return points_; }
  [[nodiscard]] const EdgeMap& map() const { return map_; }

  /** Finds the lines of the points with the scan at a pose. */
  void associate(const Pose& T_world_scan);
  /** What the matched points say at a pose (eq. 12-14). */
  [[nodiscard]] InformationSums sums(const Pose& T_world_scan, const ResidualModel& model) const;
  void stack(
      const Pose& T_world_scan, const ResidualModel& model, StackedMeasurements& stacked) const;
  /** The points join the map (eq. 21), which forgets what is far from the scan. */
  void growMap(const Pose& T_world_scan);

 private:
  double radius_;
  EdgeMap map_;
  BodyPoints points_;
  WorldPoints world_;
  std::vector<LineMatch> matches_;
};

}  // namespace fastlio
