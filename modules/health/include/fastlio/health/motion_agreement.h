// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion_agreement.h Do the scans and the inertial sensor see the same motion? A wrong
 * mounting, a wrong unit or clocks that are apart make a map that is consistent in itself, so that
 * the residuals stay small. What they cannot hide: scan after scan, the correction of the
 * prediction is many times what its covariance explains. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/filter/update.h>
#include <fastlio/health/paired_vectors.h>
#include <fastlio/health/velocity_changes.h>
#include <fastlio/interface/scan_result.h>

#include <array>
#include <cstddef>
#include <optional>

namespace fastlio
{
/** Compares predictions and their corrections, scan after scan. */
class MotionAgreement
{
 public:
  static constexpr std::size_t kWindow = 21;  //!< scans: two seconds of most LiDARs

  /** A scan corrected a prediction.
   * \param before state that the prediction began with, \a seconds before
   * \param update before anything else changes its posterior; where its points do not fit the map,
   * among trees, the scan is less certain of its pose than their noise says
   * \param by_calibration covariance of the correction of the pose that errors of the calibration
   * explain, as far as the options admit them */
  void add(
      const NavState& before, double seconds, const FilterState& predicted,
      const UpdateResult& update, const Matrix6& by_calibration);
  /** The next correction says nothing: the run begins, or the pose was searched. */
  void restart();

  /** Median over the last scans of e^T S^-1 e / 3 for the correction e of attitude or position,
   * whichever is larger, with S its covariance, those by calibration, vibration and jitter of
   * stamps included; about 1 when the model is true, 0 while too few scans are known. */
  [[nodiscard]] double innovation() const;
  /** The same with nothing explained but by the noise. */
  [[nodiscard]] double unexplainedInnovation() const;

  /** The rotation between the mounting in use and the one that the turns of the last minute show;
   * nothing while they do not determine it. */
  [[nodiscard]] std::optional<MountingError> mountingError() const;

  /** The turns of the gyro over those of the scans in the last minute; nothing while they do not
   * determine it. */
  [[nodiscard]] std::optional<GyroScale> gyroScale() const;

  /** The changes of velocity of the scans over those of the accelerometer, likewise. */
  [[nodiscard]] std::optional<RangeScale> rangeScale() const { return changes_.scale(); }

 private:
  /** The turns of the last minute. */
  struct Turns
  {
    Mat3 from_scans = Mat3::Identity();  //!< rotation that takes turns of the scans to the gyro's
    Mat3 axes = Mat3::Identity();        //!< its right singular vectors: axes of the gyro's turns
    Vec3 strengths = Vec3::Zero();       //!< of the turns about them, signed [rad^2]
    double variance = 0.0;               //!< of what one component of a turn leaves over [rad^2]
  };
  [[nodiscard]] std::optional<Turns> turns() const;

  using Window = std::array<double, kWindow>;

  /** Rings of e^T S^-1 e / 3. */
  struct Windows
  {
    Window attitude{}, position{};
  };

  [[nodiscard]] double largerMedian(const Windows& windows) const;

  Windows explained_, unexplained_;
  std::size_t corrections_ = 0;
  VelocityChanges changes_;
  std::optional<Mat3> R_last_scan_;  // attitude that the last scan alone showed
  PairedVectors turns_;              // between scans [rad]
  double interval_s_ = 0.0;          // between the last two of them
};

}  // namespace fastlio
