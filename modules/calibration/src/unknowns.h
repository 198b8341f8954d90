// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file unknowns.h The unknowns of a calibration in one vector: the error theta of extrinsic and
 * matrices, the clocks' offset, range and elevation of the beams of each elevation. */
#pragma once

#include "common_elevation.h"
#include <fastlio/calibration/calibrator.h>
#include <fastlio/calibration/rig.h>

#include <map>
#include <vector>

namespace fastlio
{
/** The evidence of all runs of a pass. */
struct PassFindings
{
  CalibrationSums sums;
  std::map<double, BeamSums> beams;  //!< by elevation
  double time_information = 0.0, time_weighted = 0.0;
  std::vector<ClockCourse> clocks;
  BiasSums incidence;
  double upright_weight = 0.0, upright_range = 0.0;  //!< as in CalibrationFindings
  std::size_t tracked = 0;
  std::vector<std::string> problems;

  void add(const CalibrationRunResult& run);
};

/** A step of least squares, each block as if it knew the others. */
struct CalibrationStep
{
  Eigen::VectorXd step;
  Eigen::MatrixXd covariance;  //!< block by block
  double innovation_scale = 1.0;
};

/** Layout of the vector, prior and steps. */
class CalibrationUnknowns
{
 public:
  /** \param pass whose beams are estimated */
  CalibrationUnknowns(const CalibrationOptions& prior, const PassFindings& pass);

  [[nodiscard]] Eigen::Index size() const;
  /** The prior of the errors that are left at \a x. */
  [[nodiscard]] CalibrationPrior prior(const Eigen::VectorXd& x) const;
  /** The rig that \a x makes of the given one. */
  [[nodiscard]] Rig rigAt(const Rig& given, const Eigen::VectorXd& x) const;
  /** From the evidence of a pass with rigAt(x). */
  [[nodiscard]] CalibrationStep step(const PassFindings& pass, const Eigen::VectorXd& x) const;
  /** How far the elevations may be stretched without anybody noticing: as a fraction, a standard
   * deviation. A gyro whose scale is as wrong about the horizontal axes of the LiDAR fits them. */
  [[nodiscard]] double stretchStd(const CalibrationStep& step) const;
  /** By which angle all elevations may be off. \param up the axis of the LiDAR, in the IMU frame */
  [[nodiscard]] CommonElevation commonElevation(
      const PassFindings& pass, const CalibrationStep& step, const Vec3& up) const;
  /** The bias of the range at 80 deg of incidence [m]. Runs do not take it off. */
  [[nodiscard]] MeasuredBias incidenceBias(
      const PassFindings& pass, const CalibrationStep& step) const;
  /** The elements that are the offsets of the beams of an elevation. */
  [[nodiscard]] Eigen::Index beamIndex(std::size_t beam) const;
  [[nodiscard]] const std::vector<double>& elevations() const { return elevations_; }

 private:
  struct ElevationLever
  {
    double mean = 0.0, squares = 0.0;  // of the elevations, and of what they differ from it
  };

  [[nodiscard]] std::vector<std::size_t> knownBeams(const CalibrationStep& step) const;
  [[nodiscard]] ElevationLever leverOf(const std::vector<std::size_t>& beams) const;
  void removeCommonPart(
      const std::vector<std::size_t>& known, const Eigen::VectorXd& x, Eigen::VectorXd& step) const;

  CalibrationOptions prior_;
  std::vector<double> elevations_;
};

constexpr Eigen::Index kTimeOffsetIndex = kCalibrationErrorDim;

}  // namespace fastlio
