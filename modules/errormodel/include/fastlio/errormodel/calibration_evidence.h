// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_evidence.h The evidence of the innovations about the error theta of the
 * calibration in use: the second stage of a two-stage filter (B. Friedland, "Treatment of bias in
 * recursive filtering", 1969), whose first stage takes the calibration for true. */
#pragma once

#include <fastlio/errormodel/calibration_error.h>
#include <fastlio/filter/scan_pose.h>
#include <fastlio/filter/update.h>
#include <fastlio/interface/odometry_options.h>

namespace fastlio
{
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
  [[nodiscard]] Matrix6 byPrior(const PoseByCalibration& pose) const;
  /** The estimate from all scans so far. */
  [[nodiscard]] const CalibrationEstimate& estimate() const { return estimate_; }
  [[nodiscard]] const CalibrationSums& sums() const { return sums_; }

 private:
  CalibrationPrior prior_;
  CalibrationSums sums_;
  int scans_ = 0;
  CalibrationEstimate estimate_;
};

}  // namespace fastlio
