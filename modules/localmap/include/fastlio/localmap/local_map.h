// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file local_map.h The map around the platform: surfaces, edges, and what is known of its errors.
 */
#pragma once

#include <fastlio/errormodel/beam_errors.h>
#include <fastlio/errormodel/calibration_error.h>
#include <fastlio/errormodel/map_error.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/localmap/saved_map.h>
#include <fastlio/map/edge_map.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/matching/match_result.h>
#include <fastlio/matching/plane_groups.h>
#include <fastlio/matching/scan_matcher.h>
#include <fastlio/parallel/workers.h>

#include <cstdint>
#include <memory>

namespace fastlio
{
/** A scan that may join the map. */
struct InsertionCandidate
{
  const DeskewedScan& scan;
  const FilterState& filter;  //!< posterior
  ScanStatus status = ScanStatus::Initializing;
  bool consistent = true;       //!< matches as scans usually match this map
  double resting_time = 0.0;    //!< how long the platform has been known to rest [s]
  double distortion_std = 0.0;  //!< of the rotation in it, by missing inertial samples [rad]
};

/** What an update did with errors that no scan corrects. */
struct ConsideredUpdate
{
  UpdateByCalibration by_calibration;
  Matrix6 map_mismatch = Matrix6::Zero();  //!< of MapErrorModel::update()
};

/** The map that scans are matched with. A new one takes its place when the old one is given up. */
class LocalMap
{
 public:
  /** An empty map. */
  LocalMap(const OdometryOptions& options, std::shared_ptr<const Workers> workers);
  /** A map of an earlier run. Nothing is dropped from it for being far away. */
  LocalMap(
      const OdometryOptions& options, std::shared_ptr<const Workers> workers,
      const SavedMap& saved);

  /** An empty map that the next scan joins: the pose goes on from this one, with its errors. */
  [[nodiscard]] LocalMap successor(
      const OdometryOptions& options, std::shared_ptr<const Workers> workers) const;

  [[nodiscard]] const SurfaceMap& surfaces() const { return *surfaces_; }
  [[nodiscard]] const EdgeMap& edges() const { return edges_; }
  [[nodiscard]] MatchedMaps matched() const { return {*surfaces_, edges_}; }
  [[nodiscard]] const MapErrorModel& error() const { return error_; }
  [[nodiscard]] const CalibrationErrorModel& calibrationError() const { return calibration_; }
  [[nodiscard]] bool empty() const { return surfaces_->pointCount() == 0; }
  /** It consists of so few scans that not much matches it yet. */
  [[nodiscard]] bool isSparse() const;
  /** It is the map of an earlier run. */
  [[nodiscard]] bool isGiven() const { return given_; }
  /** So many scans have joined it. */
  [[nodiscard]] std::uint32_t insertions() const { return insertions_; }
  /** The inlier ratio of the scans that matched this map of late; 0: none did. */
  [[nodiscard]] double usualInlierRatio() const { return usual_inlier_ratio_; }
  /** The same of the points where the map has a plane or a line. */
  [[nodiscard]] double usualFittingPart() const { return usual_fitting_part_; }

  /** The state that scans are matched with comes from a mean specific force. */
  void startCalibrationError(const NavState& x, bool tilted) { calibration_.start(x, tilted); }
  /** The effect of the errors of map and calibration on the state passes on from scan to scan. */
  void propagateError(const ErrorTransition& transition);
  /** The same through an update with velocity and gyro bias. */
  void correctError(const MotionGain& K);
  /** Takes in what an update did with the errors of map and calibration (Schmidt).
   * \param beams of the sensor \param beams_learn from the scan's residuals: those of a scan that
   * contradicts its prediction may be of a pose that is wrong */
  ConsideredUpdate considerUpdate(
      const DeskewedScan& scan, const MatchResult& match, const LinearizedUpdate& update,
      BeamErrors& beams, bool beams_learn);

  /** The scan matches as scans usually match this map, or fits what the map has there, and its
   * residuals are not those of a wrong pose. A map of a few scans takes any scan. */
  [[nodiscard]] bool isConsistent(const ScanStatistics& statistics, std::size_t points) const;
  /** Learns the usual inlier ratios, which depend on the place: nearly all points match in a room,
   * few on a meadow. */
  void learnInlierRatio(const ScanStatistics& statistics, std::size_t points);

  /** The error of the pose where the map begins is the map's, too: no scan is less accurate in it
   * for that. \param position_variance of the scan that begins it [m^2] */
  void beginAt(const Vec3& position_variance) { begun_variance_ = position_variance; }
  /** A map that nothing has joined yet takes the voxels that suit the LiDAR of \a scan. */
  void prepareFor(const DeskewedScan& scan, const OdometryOptions& options);
  /** The rule of insertion. */
  [[nodiscard]] bool accepts(const InsertionCandidate& candidate) const;
  /** The scan joins the map (eq. 21). \param surfaces its points in the world
   * \param error of the scan pose
   * \param center position of the body: what is far from it is dropped [m] */
  void insert(
      const DeskewedScan& scan, const WorldPoints& surfaces, const InsertionError& error,
      const Pose& T_world_scan, const ScanPoseJacobian& by_state, const Vec3& center);

 private:
  bool update_given_ = true;  // map.update
  double radius_ = 0.0;       // map.radius [m]
  std::unique_ptr<SurfaceMap> surfaces_;
  EdgeMap edges_;
  MapErrorModel error_;
  CalibrationErrorModel calibration_;
  PlaneGrouping groups_;
  std::shared_ptr<const Workers> workers_;
  std::uint32_t insertions_ = 0;
  double usual_inlier_ratio_ = 0.0, usual_fitting_part_ = 0.0;
  int ratios_ = 0;  // that they are means of
  Vec3 begun_variance_ = Vec3::Zero();
  bool given_ = false;
  bool succeeds_ = false;    // another one: the pose is known while this one is empty
  WorldPoints world_edges_;  // reused between scans
};

}  // namespace fastlio
