// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_evidence.h The evidence of the innovations about the error theta of the
 * calibration in use: the second stage of a two-stage filter (B. Friedland, "Treatment of bias in
 * recursive filtering", 1969), whose first stage takes the calibration for true. */
#pragma once

#include <fastlio/errormodel/calibration_error.h>
#include <fastlio/errormodel/innovation_watch.h>
#include <fastlio/filter/scan_pose.h>
#include <fastlio/filter/update.h>
#include <fastlio/interface/odometry_options.h>

#include <cstdint>
#include <optional>

namespace fastlio
{
/** What the model lacks is the same in many scans: their innovations contain so many times less
 * than their covariance says. Over simulated rigs with realistic sensors the errors are 2.5 times
 * as large (docs/calibration.md): the formal covariance takes surfaces for planes and beams for
 * lines.
 */
inline constexpr double kSystematic = 2.5 * 2.5;

/** With mean zero. */
[[nodiscard]] CalibrationPrior calibrationPriorOf(const CalibrationOptions& options);

/** Least squares for theta, with a prior. */
class CalibrationEvidence
{
 public:
  explicit CalibrationEvidence(const CalibrationOptions& options);

  /** A scan corrected a prediction, and no direction was degenerate.
   * \param innovation C of CalibrationErrorModel::update()
   * \param by_state B of the scan pose
   * \param map_mismatch of MapErrorModel::update()
   * \return mean square of the innovation's elements over the covariance that it has by the filter,
   * by theta and by the innovations so far; about 1. 0: the numbers do not tell */
  double add(
      const PoseByCalibration& innovation, const ScanPoseJacobian& by_state,
      const FilterState& predicted, const UpdateResult& update,
      const Matrix6& map_mismatch = Matrix6::Zero());

  /** Covariance of a pose that depends on theta, by the prior of the extrinsic. */
  [[nodiscard]] Matrix6 byPrior(const PoseByCalibration& pose) const;
  /** With calibration.estimate_extrinsic: the error of the extrinsic in use (kExtrinsicError), when
   * the scans show that there is one and it is time to take it off. What the motion does not
   * determine stays as given. \param now_ns the instant of the latest scan */
  [[nodiscard]] std::optional<Vector6> dueCorrection(std::int64_t now_ns);
  /** The extrinsic in use no longer has that error. */
  void takeOff(const Vector6& error);
  /** Covariance of the extrinsic in use, as far as it is estimated. */
  [[nodiscard]] Matrix6 extrinsicCovariance() const;

  /** A scan had a degenerate direction: it is no evidence, and what follows at once shows no step.
   */
  void addDegenerateScan() { watch_.interrupt(); }
  /** A scan did not correct the prediction. */
  void addUnmatchedScan() { watch_.addUnmatched(); }

  /** By how much the next scan will contradict its prediction: see InnovationWatch::expected(). */
  [[nodiscard]] double expectedInnovation() const { return watch_.expected(); }

  /** The last scans contradict their predictions so much that the inertial sensor cannot be what it
   * was. \return true once for the scans that show it */
  [[nodiscard]] bool takeStep() { return watch_.takeStep(); }

  /** The estimate from all scans so far. Its innovation_scale is at least that of the worst
   * seconds. */
  [[nodiscard]] const CalibrationEstimate& estimate() const { return estimate_; }
  [[nodiscard]] const CalibrationSums& sums() const { return sums_; }

 private:
  bool estimates_extrinsic_ = false;
  std::int64_t begin_ns_ = 0;     // of the evidence; 0: none yet
  double next_correction_ = 0.0;  // after the begin [s]
  CalibrationPrior prior_;
  CalibrationSums sums_;
  int scans_ = 0;
  InnovationWatch watch_;  // of what theta, as it was known then, does not explain
  CalibrationEstimate estimate_;
};

}  // namespace fastlio
