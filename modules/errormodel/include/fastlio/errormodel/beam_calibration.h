// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file beam_calibration.h Offsets of the beams, of their ranges, elevations and azimuths, as the
 * residuals of a run show them. */
#pragma once

#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/matching/measurement_block.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cstddef>

namespace fastlio
{
/** What the offsets of a beam do to the residual of a point. */
struct BeamView
{
  std::size_t bin = 0;  //!< beamBin()
  Vec3 by_offset;       //!< derivative by range, elevation and azimuth
};

/** Least squares for the offsets of all beams. The residual of a point has the offsets of the beam
 * that measures it, less those of the beam that created its plane, as far as the pose has not gone
 * along. What no residual shows stays zero, and as uncertain as before. */
class BeamCalibration
{
 public:
  /** \param corrects whether the offsets are taken off the scans that follow */
  explicit BeamCalibration(bool corrects) : corrects_(corrects) {}

  /** Which bins the LiDAR has; others are left alone. Forgets all. */
  void begin(std::size_t first_bin, std::size_t bins);

  /** \param created of the beam that created the plane; nullptr: not known */
  void add(const PointMeasurement& point, const BeamView& measured, const BeamView* created);
  /** The points of a scan were added. \param information H^T R^-1 H of its pose
   * \return whether the offsets are new */
  bool finishScan(const Matrix6& information);

  /** To be taken off the points of a scan. */
  [[nodiscard]] const BeamCorrections& corrections() const { return corrections_; }
  /** Of the offsets that scans have after corrections(), range [m], elevation and azimuth [rad] of
   * the first bin, then those of the next. */
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }
  [[nodiscard]] std::size_t bins() const { return bins_; }
  /** How large offsets are, before they are taken off: their standard deviation. */
  [[nodiscard]] double rangeStd() const;      //!< [m]
  [[nodiscard]] double elevationStd() const;  //!< [rad]
  [[nodiscard]] double azimuthStd() const;    //!< [rad]

 private:
  [[nodiscard]] Eigen::Index indexOf(std::size_t bin) const;
  void solve(double noise);
  void learnPrior();
  void addCommonParts();

  bool corrects_;
  std::size_t first_bin_ = 0, bins_ = 0, scans_ = 0, next_estimate_ = 0;
  Eigen::MatrixXd information_, of_scan_;
  Eigen::VectorXd weighted_, weighted_of_scan_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> with_pose_;  // D^T R^-1 H of the scan
  Vec3 prior_;                                          // variances of an offset
  Eigen::VectorXd offsets_;
  Eigen::MatrixXd covariance_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  BeamCorrections corrections_;
};

}  // namespace fastlio
