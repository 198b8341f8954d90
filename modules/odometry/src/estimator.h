// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file estimator.h The filter with its map: from prediction to insertion, scan by scan. */
#pragma once

#include "estimator_mode.h"
#include "scan_predictor.h"
#include "scan_preparation.h"
#include <fastlio/errormodel/beam_errors.h>
#include <fastlio/errormodel/calibration_evidence.h>
#include <fastlio/health/classify.h>
#include <fastlio/health/motion_agreement.h>
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/rest_detector.h>
#include <fastlio/initialization/carried_pose.h>
#include <fastlio/interface/imu_rate.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/localmap/local_map.h>
#include <fastlio/localmap/map_search.h>
#include <fastlio/localmap/place_ambiguity.h>
#include <fastlio/localmap/saved_map.h>
#include <fastlio/matching/scan_matcher.h>
#include <fastlio/parallel/workers.h>

#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace fastlio
{
/** The surface points of the last scan that joined the map. */
struct RegisteredScan
{
  WorldPoints points;
  RegisteredFields fields;

  void clear();
};

/** Initialises, tracks and relocalises; which of them is its mode. */
class Estimator
{
 public:
  explicit Estimator(const OdometryOptions& options);

  /** The run begins in a map of an earlier run; before start(). From then on the estimator counts
   * positions from the map's origin. */
  void useSavedMap(const SavedMap& saved);
  /** The first state. \param motion_window of a start in motion */
  void start(
      const FilterState& state, std::int64_t stamp_ns,
      const std::optional<MotionWindow>& motion_window);
  /** There is a state, whose motion is known. */
  [[nodiscard]] bool canGoOn() const;
  /** Goes on in a map of an earlier run, as useSavedMap(); relocalize() must follow. */
  void goOnIn(const SavedMap& saved);
  /** Searches the pose in the map around this one, which it is uncertain about by so much [m, rad],
   * until it is found. With canGoOn() only. */
  void relocalize(const Pose& T_map_imu, double position_std, double yaw_std);
  /** A pose that is lost is better searched around the prediction than by a new start: the motion
   * is known, and the map is that of the run. */
  [[nodiscard]] bool keepsState() const;
  /** The map was searched in vain, and the state is too uncertain to begin another one with. */
  [[nodiscard]] bool needsNewStart() const;
  /** Searches the pose in the map around the predicted one for a while, then begins a new map where
   * the inertial data have the pose. With keepsState() only. */
  void searchAroundPrediction();
  /** No scans until reinitialise(). Meanwhile, scans are calibrated as \a believed is. */
  void suspend(const NavState& believed);
  /** Goes on from a start of its own with the carried pose: searches for the map of before, and
   * begins a new one when it is not found. */
  void reinitialise(
      const FilterState& start, std::int64_t stamp_ns,
      const std::optional<MotionWindow>& motion_window, const CarriedPose& carried);

  /** One scan, from prediction to insertion (section III of the paper).
   * \exception std::logic_error there was no start */
  [[nodiscard]] ScanResult process(
      const LidarScan& scan, const ScanSpan& span, const ImuBuffer& imu);
  /** A scan was given up: the last one left nothing behind. */
  void skipScan();

  [[nodiscard]] bool started() const { return !std::holds_alternative<Initializing>(mode_); }
  /** The pose was carried over and the map has not been found since. */
  [[nodiscard]] bool relocalizing() const { return std::holds_alternative<Relocalizing>(mode_); }
  /** The latest state, also after suspend(). */
  [[nodiscard]] const FilterState& state() const { return state_.filter; }
  /** Its instant; 0 before the start and after suspend() [ns]. */
  [[nodiscard]] std::int64_t stamp() const { return state_.stamp_ns; }
  [[nodiscard]] const SurfaceMap& map() const { return map_.surfaces(); }
  [[nodiscard]] const RegisteredScan& registered() const { return registered_; }
  /** The prediction of the last scan at each inertial sample on the way (output.imu_rate). */
  [[nodiscard]] const std::vector<ImuRateState>& imuRateStates() const
  {
    return predictor_.imuRateStates();
  }
  /** The state at the newest inertial sample, from the latest scan; nothing before the start, while
   * the pose is not trusted, and when the latest scan is newer. */
  [[nodiscard]] std::optional<ImuRateState> stateAtNewestSample(const ImuBuffer& imu);

  [[nodiscard]] CalibrationFindings calibrationFindings() const;

  /** The estimated time offset, to be added to the stamps of scans [ns]. */
  [[nodiscard]] std::int64_t timeShift() const;
  /** Moves stamps and extrinsic of a scan by the calibration as it is estimated now. */
  void applyCalibration(LidarScan& scan, ScanSpan& span) const;

 private:
  /** A scan on its way through process(). */
  struct Work
  {
    const LidarScan& scan;
    std::int64_t end_ns;  //!< its last instant
    const DeskewedScan& deskewed;
    const ScanPrediction& predicted;
    NavState before;  //!< the state that the prediction began with
    ScanOutcome outcome = {};
    bool searched = false;                //!< the place was, not only near the prediction
    Matrix6 explained = Matrix6::Zero();  //!< of the correction, by the extrinsic's prior
  };

  [[nodiscard]] FilterRun& run();
  [[nodiscard]] ScanPrediction predict(const ScanSpan& span, const ImuBuffer& imu);
  void explainSilence(
      const LidarScan& scan, std::int64_t end_ns, const ImuBuffer& imu, ScanPrediction& predicted);
  void admitClockStep(
      const LidarScan& scan, std::int64_t end_ns, const ImuBuffer& imu, ScanPrediction& predicted);
  void followThroughGap(
      const LidarScan& scan, std::int64_t end_ns, const ImuBuffer& imu, ScanPrediction& predicted);
  void downsample(const LidarScan& scan, std::int64_t end_ns);
  const DeskewedScan& deskew(const LidarScan& scan, std::int64_t end_ns, const NavState& motion);
  [[nodiscard]] MapSearchResult matchWithMap(const Work& work);
  [[nodiscard]] MapSearchResult trackOrSearch(const Work& work);
  [[nodiscard]] MapSearchResult searchOrWait(
      const DeskewedScan& scan, const FilterState& predicted, std::int64_t end_ns);
  [[nodiscard]] MatchResult matchPrediction(const Work& work);
  [[nodiscard]] MatchResult alongOpenDirections(MatchResult match, const Work& work);
  /** \param start the prediction, more uncertain than the filter has it */
  [[nodiscard]] MatchResult pullIn(
      const Work& work, const std::optional<FilterState>& start = std::nullopt);
  [[nodiscard]] MapSearchResult searchAfterOutage(const Work& work);
  [[nodiscard]] FilterState beginNewMap(const DeskewedScan& scan, const FilterState& predicted);
  void compareMotion(
      const MapSearchResult& matched, const Work& work, const ImuBuffer& imu,
      ScanStatistics& statistics);
  void adopt(const MatchResult& match, Work& work, ScanResult& result);
  double learnFromInnovation(
      const MatchResult& match, const ConsideredUpdate& considered, const LinearizedUpdate& update,
      const Work& work);
  void noteOpenDirections(const MatchResult& match, const ScanResult& result);
  void notePlace(const MapSearchResult& matched, const DeskewedScan& scan);
  void releaseBiasesAndClock();
  void report(ScanResult& result) const;
  [[nodiscard]] StateMatrix systematicCovariance(const Prediction& prediction) const;
  void noteSupport(const MatchResult& match, Work& work, ScanResult& result);
  void applyZeroVelocityUpdate(bool matched, ScanResult& result);
  void changeMode(ScanStatus status);
  void correctExtrinsic(ScanResult& result);
  /** What was known of single planes goes with the map they were in. */
  void useMap(LocalMap map);
  void insertIntoMap(const Work& work, const ScanResult& result);
  void widenAfterFirstScan(ScanStatus status, const DeskewedScan& scan);
  void releaseTimeOffset(const ScanResult& result, const DeskewedScan& scan);

  const OdometryOptions options_;
  std::shared_ptr<const Workers> workers_;
  ScanPredictor predictor_;
  ScanPreparation preparation_;
  ScanMatcher matcher_;
  LocalMap map_;
  RestDetector rest_;
  CalibrationEvidence calibration_;
  BeamErrors beams_;
  PlaceAmbiguity ambiguity_;
  MotionAgreement agreement_;
  ScanClassifier classifier_;
  Mode mode_;
  StampedState state_;
  RegisteredScan registered_;
  StageTimings timings_;
};

}  // namespace fastlio
