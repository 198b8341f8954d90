// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_update.h The iterated update of the filter by one scan (eq. 12-20). */
#pragma once

#include "edge_stage.h"
#include <fastlio/filter/scan_pose.h>
#include <fastlio/filter/update.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/odometry/degeneracy.h>
#include <fastlio/odometry/parameters.h>
#include <fastlio/odometry/point_to_plane.h>
#include <fastlio/parallel/workers.h>

#include <memory>
#include <vector>

namespace fastlio
{
/** A scan ready to be matched: its points in the body frame at its end, and how they got there. */
struct CompensatedScan
{
  BodyPoints points;
  CompensatedWith compensation;
};

/** Matches a scan with the map and updates the filter; keeps the storage between scans. */
class ScanUpdate
{
 public:
  ScanUpdate(const Parameters& parameters, std::shared_ptr<const Workers> workers);

  /** Iterates matching and update from a prediction. The scan does not correct it when fewer than
   * measurement.min_effective_points match.
   * \param edges the scan's edge points, which are matched as well; may have none */
  [[nodiscard]] UpdateResult run(
      const FilterState& predicted, const CompensatedScan& scan, const SurfaceMap& map,
      EdgeStage& edges);

  /** The matches of the last association. */
  [[nodiscard]] const std::vector<PlaneMatch>& matches() const { return matches_; }
  /** What decided on the matches of the last run. */
  [[nodiscard]] const ResidualModel& residualModel() const { return model_; }
  /** Which directions the last run updated. */
  [[nodiscard]] const ScanConstraints& constraints() const { return constraints_; }
  /** Time spent on searching the map in the last run [ms]. */
  [[nodiscard]] double associationMilliseconds() const { return association_ms_; }

 private:
  void associate(
      const Pose& T_world_scan, const BodyPoints& points, const SurfaceMap& map, EdgeStage& edges);
  void findConstraints(
      const Pose& T_world_scan, const BodyPoints& points, const InformationSums& sums);
  [[nodiscard]] MeasurementEvaluation evaluate(
      const NavState& iterate, int iteration, const CompensatedScan& scan, const SurfaceMap& map,
      EdgeStage& edges);

  const Parameters& parameters_;
  std::shared_ptr<const Workers> workers_;
  ResidualModel model_;
  ScanConstraints constraints_;
  double association_ms_ = 0.0;
  // Reused between scans.
  WorldPoints world_;
  std::vector<PlaneMatch> matches_;
  std::vector<InformationSums> chunk_sums_;
  std::vector<Matrix6> chunk_noise_;
};

}  // namespace fastlio
