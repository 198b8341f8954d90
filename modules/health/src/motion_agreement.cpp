// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/motion_agreement.h>
#include <fastlio/math/so3.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using Square6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

// Turns of less than this, root mean square, are mostly noise [rad].
constexpr double kLeastTurn = 0.004;
// A second axis of rotation with less of the first one's singular value says nothing.
constexpr double kLeastSecondAxis = 0.05;

// Every platform does it and no noise density includes it: vibration between the inertial samples
// turns and shifts it, and stamps are good to half a millisecond.
constexpr double kVibrationAngle = 5e-4;  // [rad]
constexpr double kVibrationShift = 1e-3;  // [m]
constexpr double kStampJitter = 5e-4;     // [s]

// While a turn begins, clocks that are apart and the filter of an IMU look like a scale of the
// gyro: what is left of both before the offset of the clocks is known.
constexpr double kLag = 5e-3;  // [s]

/** Covariance of a correction by vibration and jitter. */
Matrix6 byVibration(const NavState& x)
{
  const Vec3 shift = kStampJitter * x.v;
  Matrix6 C = Matrix6::Zero();
  C.topLeftCorner<3, 3>() = kVibrationAngle * kVibrationAngle * Mat3::Identity();
  C.bottomRightCorner<3, 3>() =
      kVibrationShift * kVibrationShift * Mat3::Identity() + shift * shift.transpose();
  return C;
}

/** e^T S^-1 e / 3 for three elements of a correction; S is what the update took off P, times what
 * the points leave over of their noise, and what else explains it. */
double normalized(
    const StateVector& correction, const FilterState& predicted, const UpdateResult& update,
    const Matrix6& explained, int block)
{
  const Vec3 e = correction.segment<3>(block);
  const double residuals = std::max(normalizedInnovation(update), 1.0);
  const Mat3 S = residuals * (predicted.P.block<3, 3>(block, block) -
                              update.posterior.P.block<3, 3>(block, block)) +
                 explained.block<3, 3>(block, block);
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(S);
  if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 0.0)) return 0.0;
  return e.dot(ldlt.solve(e).eval()) / 3.0;
}

/** The pose that the scan alone shows: without the weight that the prediction had. */
struct PoseOfScan
{
  PoseOfScan(
      const StateVector& correction, const FilterState& predicted, const FilterState& posterior)
  {
    const Square6 P = predicted.P.topLeftCorner<6, 6>();
    const Eigen::LDLT<Square6> S(P - posterior.P.topLeftCorner<6, 6>());
    const Vec6 e = P * S.solve(correction.head<6>());
    T_world_imu.R = predicted.x.R * expSO3(e.head<3>());
    T_world_imu.p = predicted.x.p + e.tail<3>();
    const Square6 covariance = P * S.solve(P) - P;
    position_std = std::sqrt(std::max(0.0, covariance.diagonal().tail<3>().maxCoeff()));
  }

  Pose T_world_imu;
  double position_std = 0.0;  // largest of an axis [m]
};

double medianOf(std::array<double, MotionAgreement::kWindow> values)
{
  auto* const middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Standard deviation of a rotation along itself that Wahba's problem gave.
 * \param strengths of the turns about the columns of \a axes: sums of squares [rad^2]
 * \param variance of what one component of a turn leaves over [rad^2] */
double stdAlong(const Vec3& rotation, const Mat3& axes, const Vec3& strengths, double variance)
{
  const Vec3 along = axes.transpose() * rotation.normalized();
  const Vec3 information(
      strengths[1] + strengths[2], strengths[0] + strengths[2], strengths[0] + strengths[1]);
  return std::sqrt(variance * along.cwiseAbs2().dot(information.cwiseInverse()));
}
}  // namespace

void MotionAgreement::add(
    const NavState& before, double seconds, const FilterState& predicted,
    const UpdateResult& update, const Matrix6& by_calibration)
{
  const FilterState& posterior = update.posterior;
  const StateVector correction = boxminus(posterior.x, predicted.x);
  const std::size_t slot = corrections_ % kWindow;
  const Matrix6 nothing = Matrix6::Zero();
  const Matrix6 harmless = by_calibration + byVibration(predicted.x);
  const auto at = [&](int block, const Matrix6& explained)
  { return normalized(correction, predicted, update, explained, block); };
  explained_.attitude[slot] = at(kAttitude, harmless);
  explained_.position[slot] = at(kPosition, harmless);
  unexplained_.attitude[slot] = at(kAttitude, nothing);
  unexplained_.position[slot] = at(kPosition, nothing);
  ++corrections_;
  const PoseOfScan scan(correction, predicted, posterior);
  const Mat3& R_scan = scan.T_world_imu.R;
  // As the gyro measured it: the filter's bias takes in what a wrong scale does in a long turn.
  const Vec3 inertial = logSO3(before.R.transpose() * predicted.x.R) + seconds * before.gyro_bias;
  if (R_last_scan_) turns_.add(logSO3(R_last_scan_->transpose() * R_scan), inertial);
  R_last_scan_ = R_scan;
  interval_s_ = seconds;
  changes_.add(before, seconds, predicted.x, scan.T_world_imu.p, scan.position_std);
}

void MotionAgreement::restart()
{
  corrections_ = 0;
  R_last_scan_.reset();
  changes_.restart();
}

double MotionAgreement::largerMedian(const Windows& windows) const
{
  if (corrections_ < kWindow) return 0.0;
  return std::max(medianOf(windows.attitude), medianOf(windows.position));
}

double MotionAgreement::innovation() const
{
  return largerMedian(explained_);
}

double MotionAgreement::unexplainedInnovation() const
{
  return largerMedian(unexplained_);
}

std::optional<MotionAgreement::Turns> MotionAgreement::turns() const
{
  if (!turns_.enough()) return std::nullopt;
  const double inertial_squares = turns_.inertialSquares(), scan_squares = turns_.scanSquares();
  if (!(inertial_squares > turns_.count() * kLeastTurn * kLeastTurn) || !(scan_squares > 0.0))
    return std::nullopt;
  // Wahba's problem.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      turns_.products(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  const Vec3 signs(1.0, 1.0, sign);
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): g++ fears for a reference
  const Vec3 sizes = svd.singularValues();
  Turns turns;
  turns.strengths = sizes.cwiseProduct(signs);
  turns.axes = svd.matrixV();
  turns.from_scans = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  const double common = turns.strengths.sum();
  if (common < PairedVectors::kLeastCorrelation * std::sqrt(inertial_squares * scan_squares))
    return std::nullopt;
  const double left_over = inertial_squares + scan_squares - 2.0 * common;
  turns.variance = std::max(left_over, 0.0) / (3.0 * turns_.count());
  return turns;
}

std::optional<MountingError> MotionAgreement::mountingError() const
{
  const auto seen = turns();
  if (!seen || seen->strengths[1] < kLeastSecondAxis * seen->strengths[0]) return std::nullopt;
  MountingError error;
  error.R_true_given = seen->from_scans;
  const Vec3 rotation = logSO3(error.R_true_given);
  error.angle = rotation.norm();
  error.std = stdAlong(rotation, seen->axes, seen->strengths, seen->variance);
  return error;
}

std::optional<GyroScale> MotionAgreement::gyroScale() const
{
  const auto seen = turns();
  if (!seen) return std::nullopt;
  GyroScale scale;
  const double common = seen->strengths.sum();
  scale.lower = common / turns_.scanSquares();
  scale.upper = turns_.inertialSquares() / common;
  const double by_lag = kLag / interval_s_ * turns_.lagProduct() / turns_.inertialSquares();
  scale.std = std::hypot(std::sqrt(seen->variance / turns_.scanSquares()), by_lag);
  return scale;
}

}  // namespace fastlio
