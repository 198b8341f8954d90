// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_matcher.h Matches a scan with the map and corrects the prediction (eq. 12-20). */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/edge_map.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/matching/degeneracy.h>
#include <fastlio/matching/match_result.h>
#include <fastlio/matching/measured_scan.h>
#include <fastlio/matching/point_to_plane.h>
#include <fastlio/matching/pose_match.h>
#include <fastlio/parallel/workers.h>

#include <memory>
#include <optional>
#include <vector>

namespace fastlio
{
/** How a scan is matched. */
struct MatchOptions
{
  MeasurementOptions measurement;  //!< noise and gates
  int association_iterations = 2;  //!< so many iterations search the map anew; more move no match
  IterationLimits limits;          //!< of the iterated update
  bool at_start = false;           //!< a start in motion: no direction is left out lightly
  GainForm gain = GainForm::Information;
  /** Where the iterations start, and how near that is; the prediction if there is none. */
  std::optional<FilterState> start;
  /** How far deskewing may have moved the points beside the sensor's noise, all of them together
   * [m]. */
  double deskew_std = 0.0;
  /** Of the scans that the planes were made of, where the planes do not hold it [rad^2]. */
  double map_attitude_variance = 0.0;
  /** The gate takes the prediction to be so much less certain, as a factor of its covariance. */
  double gate_factor = 1.0;
};

/** As the options say: for a prediction that is near. */
[[nodiscard]] MatchOptions ordinaryMatching(const OdometryOptions& options);
/** With more iterations: for a prediction that may be far off. */
[[nodiscard]] MatchOptions pullInMatching(const OdometryOptions& options);

/** The maps that a scan is matched with. */
struct MatchedMaps
{
  const SurfaceMap& surfaces;
  const EdgeMap& edges;
};

/** Matches scans with maps. A result depends on the arguments only; the object keeps storage. */
class ScanMatcher
{
 public:
  explicit ScanMatcher(std::shared_ptr<const Workers> workers);

  /** Iterates matching and update from a prediction (eq. 12-20). The scan does not correct it when
   * fewer than kMinEffectivePoints match.
   * \return its matches and measurements are valid until the next call */
  [[nodiscard]] MatchResult match(
      const DeskewedScan& scan, const FilterState& predicted, const MatchedMaps& maps,
      const MatchOptions& options);

  /** The same where only the pose is uncertain, by so much at each of the starts: eq. 12-20 in six
   * dimensions. The starts share the threads.
   * \return one for each start, in their order */
  [[nodiscard]] std::vector<PoseMatch> matchPoses(
      const DeskewedScan& scan, const std::vector<PoseStart>& starts, const MatchedMaps& maps,
      const MatchOptions& options);

 private:
  /** One call of match(). */
  struct Call
  {
    const DeskewedScan& scan;
    const MatchedMaps& maps;
    const MatchOptions& options;
    MatchResult& result;
  };

  void makeRoomFor(const DeskewedScan& scan);
  [[nodiscard]] PoseMatch matchPose(
      const DeskewedScan& scan, const PoseStart& start, const MatchedMaps& maps,
      const MatchOptions& options);
  [[nodiscard]] MeasurementEvaluation evaluate(
      const NavState& iterate, int iteration, const Call& call);
  [[nodiscard]] InformationSums measure(const Pose& T_world_scan, int iteration, const Call& call);
  void associate(const Pose& T_world_scan, int iteration, const Call& call);
  void findConstraints(const Mat3& R_world_scan, const InformationSums& sums, const Call& call);

  std::shared_ptr<const Workers> workers_;
  // Reused between scans.
  WorldPoints world_, world_before_, world_edges_;
  Pose associated_at_;
  std::vector<PlaneMatch> matches_;
  std::vector<LineMatch> edge_matches_;
  MeasuredScan measured_;
  std::vector<Matrix6> chunk_noise_;
  StrongestPlanes strongest_planes_;
};

}  // namespace fastlio
