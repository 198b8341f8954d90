// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_sums.h The evidence of a run about the error theta of the calibration that it used:
 * sums that add up over runs, and their solution. docs/covariance.md has the equations. */
#pragma once

#include <fastlio/math/linear_algebra.h>

#include <vector>

namespace fastlio
{
/** First index of each block of theta. Extrinsic: in use = true [+] theta, rotation and translation
 * as in StateBlock. Gyro and accelerometer: their matrices are I + theta, by columns
 * (InertialSensitivity). */
enum CalibrationErrorBlock : int
{
  kExtrinsicError = 0,
  kGyroMatrixError = 6,
  kAccelMatrixError = 15
};
constexpr int kCalibrationErrorDim = 24;

using CalibrationErrorVector = Eigen::Matrix<double, kCalibrationErrorDim, 1, Eigen::DontAlign>;
using CalibrationErrorMatrix =
    Eigen::Matrix<double, kCalibrationErrorDim, kCalibrationErrorDim, Eigen::DontAlign>;

/** Normal equations of least squares for theta: the innovations y = -C theta + noise of scans, with
 * the weights W. */
struct CalibrationSums
{
  CalibrationErrorMatrix information = CalibrationErrorMatrix::Zero();  //!< sum C^T W C
  CalibrationErrorVector weighted = CalibrationErrorVector::Zero();     //!< -sum C^T W y
  double squares = 0.0;                                                 //!< sum y^T W y
  double count = 0.0;                                                   //!< of elements of y

  CalibrationSums& operator+=(const CalibrationSums& other);
};

/** The prior of theta: independent errors, possibly zero. */
struct CalibrationPrior
{
  CalibrationErrorVector mean = CalibrationErrorVector::Zero();
  CalibrationErrorVector std = CalibrationErrorVector::Zero();
};

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

/** \param systematic the innovations hold so many times less information than their covariance says, because
 * what the model lacks is the same in many scans */
[[nodiscard]] CalibrationEstimate solve(
    const CalibrationSums& sums, const CalibrationPrior& prior, double systematic = 1.0);

/** Normal equations for the offsets of the beams of one elevation: of their range, measured less
 * true [m], and of their elevation, in use less true [rad]. */
struct BeamSums
{
  double elevation = 0.0;  //!< of the middle of the bin [rad]
  Eigen::Matrix<double, 2, 2, Eigen::DontAlign> information =
      Eigen::Matrix<double, 2, 2, Eigen::DontAlign>::Zero();  //!< range, elevation
  Eigen::Matrix<double, 2, 1, Eigen::DontAlign> weighted =
      Eigen::Matrix<double, 2, 1, Eigen::DontAlign>::Zero();
};

/** Normal equation of a single unknown. */
struct BiasSums
{
  double information = 0.0, weighted = 0.0;
};

/** All evidence of a run about the calibration it used. */
struct CalibrationFindings
{
  CalibrationSums sums;
  std::vector<BeamSums> beams;  //!< ascending by elevation, those that were seen
  /** Of the bias of the range at 80 deg of incidence, measured less true [m]. */
  BiasSums incidence;
  /** Sums over upright surfaces, weighted by how far they determine the horizontal position
   * [1/m^2], and the same times their range [1/m]. */
  double upright_weight = 0.0, upright_range = 0.0;
};

}  // namespace fastlio
