// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/calibration_evidence.h>
#include <fastlio/math/time.h>

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

// Beside so many scans one more adds little: from then on one in so many is followed by a
// solution.
constexpr int kScansSolvedEach = 20;
constexpr int kScansPerSolution = 10;

// An error of six components that is none exceeds it once in 20 times.
constexpr double kSignificant = 50.0;
// A correction begins a new map, so there are few: each waits 1.5 times as long as the one before.
constexpr double kFirstCorrection = 8.0, kNextCorrection = 1.5;  // [s], factor

bool isPositive(const Eigen::LDLT<Square6>& ldlt)
{
  return ldlt.info() == Eigen::Success && ldlt.vectorD().minCoeff() > 0.0;
}

/** By how much y^T W y is smaller when the covariance of y has the positive part M of \a mismatch,
 * too: (W^-1 + M)^-1 = W - W M (1 + W M)^-1 W. \param Wy W y */
double explainedByMap(const Square6& W, const Vec6& Wy, const Matrix6& mismatch)
{
  const Square6 M = positivePart(mismatch);
  const Vec6 corrected = Square6(Square6::Identity() + W * M).partialPivLu().solve(Wy);
  return Wy.dot(M * corrected);
}
}  // namespace

CalibrationPrior calibrationPriorOf(const CalibrationOptions& options)
{
  CalibrationPrior prior;
  for (const int first : {static_cast<int>(kGyroMatrixError), static_cast<int>(kAccelMatrixError)})
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        prior.std[first + 3 * column + row] =
            row == column ? options.imu_scale_std : options.imu_misalignment_std;
  prior.std.segment<3>(kExtrinsicError).setConstant(options.extrinsic_rotation_std);
  prior.std.segment<3>(kExtrinsicError + 3).setConstant(options.extrinsic_translation_std);
  return prior;
}

CalibrationEvidence::CalibrationEvidence(const CalibrationOptions& options)
    : estimates_extrinsic_(options.estimate_extrinsic),
      next_correction_(kFirstCorrection),
      prior_(calibrationPriorOf(options))
{
  estimate_ = solve(sums_, prior_);
}

double CalibrationEvidence::add(
    const PoseByCalibration& innovation, const ScanPoseJacobian& by_state,
    const FilterState& predicted, const UpdateResult& update, const Matrix6& map_mismatch)
{
  const Eigen::Matrix<double, 6, kStateDim> B = by_state;
  const Square6 P = productByTransposed(product(B, predicted.P), B);
  const Square6 information = update.last.HtRinvH;
  const Vec6 correction = B * boxminus(update.posterior.x, predicted.x);
  const Eigen::LDLT<Square6> P_ldlt(P), information_ldlt(information);
  if (!isPositive(P_ldlt) || !isPositive(information_ldlt)) return 0.0;
  // The innovation y has the covariance W^-1 = information^-1 + P; the filter corrects by P W y.
  const Vec6 Wy = P_ldlt.solve(correction);
  const Square6 W =
      Square6(Square6::Identity() + information * P).partialPivLu().solve(information);
  const PoseByCalibration weighted = product(W, innovation);
  const Eigen::Matrix<double, kCalibrationErrorDim, kCalibrationErrorDim> information_of_error =
      innovation.transpose() * weighted;
  const double squares = Wy.dot(information_ldlt.solve(Wy) + P * Wy);
  const Vec6 by_error = innovation * estimate_.mean;
  const double elements = 6.0 + information_of_error.cwiseProduct(estimate_.covariance).sum();
  const double unexplained = squares + by_error.dot(2.0 * Wy + W * by_error);
  // Of a pose that was lost for long, numbers may overflow. They would stay in all sums.
  if (!information_of_error.allFinite() || !Wy.allFinite() || !std::isfinite(unexplained))
    return 0.0;
  const double surprise = unexplained / elements / estimate_.innovation_scale;
  const Vec6 W_unexplained = Wy + W * by_error;  // W y of what is left of y
  watch_.add(
      unexplained / elements, normalizedInnovation(update),
      (unexplained - explainedByMap(W, W_unexplained, map_mismatch)) / elements);
  sums_.information += information_of_error;
  sums_.weighted -= innovation.transpose() * Wy;
  sums_.squares += squares;
  sums_.count += 6.0;
  ++scans_;
  if (scans_ <= kScansSolvedEach || scans_ % kScansPerSolution == 0)
    estimate_ = solve(sums_, prior_);
  estimate_.innovation_scale = std::max(estimate_.innovation_scale, watch_.worst());
  return surprise;
}

std::optional<Vector6> CalibrationEvidence::dueCorrection(std::int64_t now_ns)
{
  if (!estimates_extrinsic_) return std::nullopt;
  if (begin_ns_ == 0) begin_ns_ = now_ns;
  const double seconds = toSeconds(now_ns - begin_ns_);
  if (seconds < next_correction_) return std::nullopt;
  next_correction_ = kNextCorrection * seconds;
  const CalibrationEstimate estimate = solve(sums_, prior_, kSystematic);
  const Vec6 error = estimate.mean.segment<6>(kExtrinsicError);
  const Square6 covariance = estimate.covariance.block<6, 6>(kExtrinsicError, kExtrinsicError);
  const Eigen::LDLT<Square6> ldlt(covariance);
  if (!isPositive(ldlt) || error.dot(ldlt.solve(error)) < kSignificant) return std::nullopt;
  return Vector6(error);
}

void CalibrationEvidence::takeOff(const Vector6& error)
{
  CalibrationErrorVector taken = CalibrationErrorVector::Zero();
  taken.segment<6>(kExtrinsicError) = error;
  const CalibrationErrorVector pull = sums_.information * taken;
  sums_.squares += taken.dot(pull) - 2.0 * taken.dot(sums_.weighted);
  sums_.weighted -= pull;
  prior_.mean -= taken;
  watch_ = {};  // that error was in the innovations it has seen
  estimate_ = solve(sums_, prior_);
}

Matrix6 CalibrationEvidence::extrinsicCovariance() const
{
  if (!estimates_extrinsic_) return Matrix6::Zero();
  return solve(sums_, prior_, kSystematic).covariance.block<6, 6>(kExtrinsicError, kExtrinsicError);
}

Matrix6 CalibrationEvidence::byPrior(const PoseByCalibration& pose) const
{
  const PoseByCalibration scaled = pose * prior_.std.asDiagonal();
  return scaled * scaled.transpose();
}

}  // namespace fastlio
