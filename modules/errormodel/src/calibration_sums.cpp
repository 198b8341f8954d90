// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/calibration_sums.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using SquareTheta = Eigen::Matrix<double, kCalibrationErrorDim, kCalibrationErrorDim>;
using VecTheta = Eigen::Matrix<double, kCalibrationErrorDim, 1>;
}  // namespace

CalibrationSums& CalibrationSums::operator+=(const CalibrationSums& other)
{
  information += other.information;
  weighted += other.weighted;
  squares += other.squares;
  count += other.count;
  return *this;
}

CalibrationEstimate solve(
    const CalibrationSums& sums, const CalibrationPrior& prior, double systematic)
{
  // Of what is not at the prior's mean, in units of the prior, which may be zero: (I + Lambda)^-1.
  const VecTheta std = prior.std, mean = prior.mean;
  const VecTheta pull = SquareTheta(sums.information) * mean;
  const VecTheta weighted = std.asDiagonal() * (VecTheta(sums.weighted) - pull);
  const SquareTheta information =
      std.asDiagonal() * SquareTheta(sums.information) * std.asDiagonal();
  const SquareTheta I = SquareTheta::Identity();
  const double squares = sums.squares - 2.0 * mean.dot(VecTheta(sums.weighted)) + mean.dot(pull);
  const double explained = weighted.dot((I + information).ldlt().solve(weighted));
  // Of white noise the mean would stay below this bound in 99.9 % of all runs.
  const double count = std::max(sums.count, 1.0);
  const double chance = 1.0 + 3.0 * std::sqrt(2.0 / count);
  const double scale = std::max(1.0, (squares - explained) / count / chance);
  const double inflation = scale * systematic;
  const SquareTheta P = (I + information / inflation).llt().solve(I);
  CalibrationEstimate estimate;
  estimate.innovation_scale = scale;
  estimate.mean = mean + std.asDiagonal() * (P * weighted / inflation);
  estimate.covariance = std.asDiagonal() * P * std.asDiagonal();
  estimate.second_moment = estimate.covariance + estimate.mean * estimate.mean.transpose();
  return estimate;
}

}  // namespace fastlio
