// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_evidence.h What the innovations of the scans tell about the error theta of the
 * calibration in use: the second stage of a two-stage filter (B. Friedland, "Treatment of bias in
 * recursive filtering", 1969), whose first stage takes the calibration for true. */
#pragma once

#include "calibration_error.h"
#include <fastlio/filter/scan_pose.h>
#include <fastlio/filter/update.h>
#include <fastlio/odometry/odometry_options.h>

namespace fastlio
{
/** The error theta of the calibration in use, as the innovations show it. */
struct CalibrationEstimate
{
  CalibrationErrorVector mean = CalibrationErrorVector::Zero();
  CalibrationErrorMatrix covariance = CalibrationErrorMatrix::Zero();
  CalibrationErrorMatrix second_moment = CalibrationErrorMatrix::Zero();  //!< E[theta theta^T]
  /** How many times their covariance the squares of the innovations are on average, but for what
   * theta explains; 1 when they are less. */
  double innovation_scale = 1.0;
};

/** Least squares for theta, with a prior. */
class CalibrationEvidence
{
 public:
  explicit CalibrationEvidence(const CalibrationOptions& options);

  /** A scan corrected a prediction, and no direction was degenerate.
   * \param innovation C of CalibrationErrorModel::update()
   * \param by_state B of the scan pose */
  void add(
      const PoseByCalibration& innovation, const ScanPoseJacobian& by_state,
      const FilterState& predicted, const UpdateResult& update);

  /** Covariance of a pose that depends on theta, by the prior of the extrinsic. */
  [[nodiscard]] Matrix6 byExtrinsicPrior(const PoseByCalibration& pose) const;
  /** What all scans so far tell. */
  [[nodiscard]] const CalibrationEstimate& estimate() const { return estimate_; }

 private:
  void solve();

  CalibrationErrorVector prior_std_;
  CalibrationErrorMatrix information_ = CalibrationErrorMatrix::Zero();
  CalibrationErrorVector weighted_ = CalibrationErrorVector::Zero();
  double squares_ = 0.0;  // of the normalised innovations
  double count_ = 0.0;    // of their elements
  int scans_ = 0;
  CalibrationEstimate estimate_;
};

}  // namespace fastlio
