// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "calibration_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using Square6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using SquareTheta = Eigen::Matrix<double, kCalibrationErrorDim, kCalibrationErrorDim>;
using VecTheta = Eigen::Matrix<double, kCalibrationErrorDim, 1>;

// Beside so many scans one more tells little: from then on one in so many is followed by a solution.
constexpr int kScansSolvedEach = 20;
constexpr int kScansPerSolution = 10;

bool isPositive(const Eigen::LDLT<Square6>& ldlt)
{
  return ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > 0.0;
}
}  // namespace

CalibrationEvidence::CalibrationEvidence(const CalibrationOptions& options)
{
  const auto matrix = [&](int first)
  {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        prior_std_[first + 3 * column + row] =
            row == column ? options.imu_scale_std : options.imu_misalignment_std;
  };
  matrix(kGyroMatrixError);
  matrix(kAccelMatrixError);
  const bool estimated = options.estimate_extrinsic;  // by the filter itself
  prior_std_.segment<3>(kExtrinsicError)
      .setConstant(estimated ? 0.0 : options.extrinsic_rotation_std);
  prior_std_.segment<3>(kExtrinsicError + 3)
      .setConstant(estimated ? 0.0 : options.extrinsic_translation_std);
  solve();
}

void CalibrationEvidence::add(
    const PoseByCalibration& innovation, const ScanPoseJacobian& by_state,
    const FilterState& predicted, const UpdateResult& update)
{
  const Eigen::Matrix<double, 6, kStateDim> B = by_state;
  const Square6 P = productByTransposed(product(B, predicted.P), B);
  const Square6 information = update.last.HtRinvH;
  const Vec6 correction = B * boxminus(update.posterior.x, predicted.x);
  const Eigen::LDLT<Square6> P_ldlt(P), information_ldlt(information);
  if (!isPositive(P_ldlt) || !isPositive(information_ldlt)) return;
  // The innovation y has the covariance W^-1 = information^-1 + P; the filter corrects by P W y.
  const Vec6 Wy = P_ldlt.solve(correction);
  const Square6 W =
      Square6(Square6::Identity() + information * P).partialPivLu().solve(information);
  const PoseByCalibration weighted = product(W, innovation);
  information_ += innovation.transpose() * weighted;
  weighted_ -= innovation.transpose() * Wy;
  squares_ += Wy.dot(information_ldlt.solve(Wy) + P * Wy);
  count_ += 6.0;
  ++scans_;
  if (scans_ <= kScansSolvedEach || scans_ % kScansPerSolution == 0) solve();
}

Matrix6 CalibrationEvidence::byExtrinsicPrior(const PoseByCalibration& pose) const
{
  const Matrix6 scaled =
      pose.middleCols<6>(kExtrinsicError) * prior_std_.segment<6>(kExtrinsicError).asDiagonal();
  return scaled * scaled.transpose();
}

void CalibrationEvidence::solve()
{
  // In units of the prior, which may be zero: (I + Lambda)^-1.
  const VecTheta std = prior_std_, weighted = std.asDiagonal() * weighted_;
  const SquareTheta information = std.asDiagonal() * SquareTheta(information_) * std.asDiagonal();
  const SquareTheta I = SquareTheta::Identity();
  const double explained = weighted.dot((I + information).ldlt().solve(weighted));
  // Of white noise the mean would stay below this bound in 99.9 % of all runs.
  const double chance = 1.0 + 3.0 * std::sqrt(2.0 / std::max(count_, 1.0));
  const double mean = (squares_ - explained) / std::max(count_, 1.0);
  const double scale = std::max(1.0, mean / chance);
  const SquareTheta P = (I + information / scale).llt().solve(I);
  estimate_.innovation_scale = scale;
  estimate_.mean = std.asDiagonal() * (P * weighted / scale);
  estimate_.covariance = std.asDiagonal() * P * std.asDiagonal();
  estimate_.second_moment = estimate_.covariance + estimate_.mean * estimate_.mean.transpose();
}

}  // namespace fastlio
