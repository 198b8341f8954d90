// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/map_error.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace fastlio
{
namespace
{
using AlignedMatrix6 = Eigen::Matrix<double, 6, 6>;
using StateBy6 = Eigen::Matrix<double, kStateDim, 6, Eigen::DontAlign>;
using SixByNavigation = Eigen::Matrix<double, 6, kNavigationDim>;

/** C with C C^T = m for a positive semi-definite m. */
AlignedMatrix6 squareRoot(const AlignedMatrix6& m)
{
  // Keeps the factor finite where some direction has no error at all.
  constexpr double kRelativeFloor = 1e-12;
  const AlignedMatrix6 floor =
      (kRelativeFloor * m.diagonal().array() + 1e-300).matrix().asDiagonal();
  const Eigen::LLT<AlignedMatrix6> llt(m + floor);
  return llt.info() == Eigen::Success ? AlignedMatrix6(llt.matrixL())
                                      : AlignedMatrix6(AlignedMatrix6::Zero());
}

/** Rows of attitude and position with which all rows together move the scan pose by \a scan_pose,
 * without those of the calibration: all scans determine it together, so it is taken as it is. */
NavigationBy6 withoutCalibration(
    const ScanPoseJacobian& by_state, const Matrix6& scan_pose, const StateBy6& rows)
{
  constexpr int kOthers = kNavigationDim - 6;
  NavigationBy6 of = rows.topRows<kNavigationDim>();
  const AlignedMatrix6 by_others = by_state.middleCols<kOthers>(6) * of.bottomRows<kOthers>();
  of.topRows<6>() =
      AlignedMatrix6(by_state.leftCols<6>()).partialPivLu().solve(scan_pose - by_others);
  return of;
}

/** The filter's gain of the sums of a scan along the directions that it has updated. */
NavigationBy6 gainOf(const LinearizedUpdate& update)
{
  const Matrix6 scan_pose = product(update.by_state, update.gain);
  return product(
      withoutCalibration(update.by_state, scan_pose, update.gain),
      Matrix6(update.constraints.projection.transpose()));
}

/** C_b, a square root of the covariance of the sums by errors of the beams. It is taken in the axes
 * of the body: there it changes little from scan to scan, so that eta stays what it is in a turn.
 */
AlignedMatrix6 sensorErrors(const Matrix6& covariance, const Mat3& R_world_scan)
{
  AlignedMatrix6 turn = AlignedMatrix6::Identity();
  turn.bottomRightCorner<3, 3>() = R_world_scan;
  return turn * squareRoot(turn.transpose() * covariance * turn);
}

/** R of eta_p <- R eta_p + what is new. \param with_before GroupedMeasurements::plane_errors_before
 * \param C C_p of the scan */
Matrix6 persistence(const Matrix6& with_before, const Matrix6& C, const Matrix6& C_before)
{
  if (with_before.isZero(0.0) || C.isZero(0.0) || C_before.isZero(0.0)) return Matrix6::Zero();
  const AlignedMatrix6 left = C.triangularView<Eigen::Lower>().solve(with_before);
  return C_before.triangularView<Eigen::Lower>().solve(left.transpose()).transpose();
}
}  // namespace

void MapErrorModel::propagate(const ErrorTransition& transition)
{
  const Eigen::Matrix<double, kMotionDim, kNavigationDim> Phi =
      transition.by_state.leftCols<kNavigationDim>();
  addition_.topRows<kMotionDim>() = product(Phi, addition_);
  addition_.leftCols<kMotionDim>() = productByTransposed(addition_, Phi);
  considered_.propagate(transition);
}

void MapErrorModel::correct(const MotionGain& K)
{
  const NavigationBy6 of_navigation = K.topRows<kNavigationDim>();
  addition_ -= product(of_navigation, SixByNavigation(addition_.middleRows<6>(kVelocity)));
  addition_ -=
      productByTransposed(NavigationBy6(addition_.middleCols<6>(kVelocity)), of_navigation);
  considered_.correct(of_navigation);
}

Matrix6 MapErrorModel::update(
    const LinearizedUpdate& update, const GroupedMeasurements& scan, const Matrix6& beam_errors)
{
  if (scan.groups.empty()) return Matrix6::Zero();
  const Matrix6 of_planes = squareRoot(scan.plane_errors);
  considered_.renewPlanes(persistence(scan.plane_errors_before, of_planes, of_planes_));
  of_planes_ = of_planes;
  const ConsideredErrors::Sources s = considered_.sourcesOf(update.T_world_scan, scan);
  const SixByNavigation B = update.by_state.leftCols<kNavigationDim>();

  // Of B e - x. Where the planes are those of the scans just before, both have the same error.
  const Matrix6 common = B * s.with_state.rightCols<6>();
  Matrix6 mismatch = productByTransposed(product(B, addition_), B) - common - common.transpose() +
                     s.covariance.bottomRightCorner<6, 6>();

  // e <- e - G (M B e - K s)
  const Matrix6 M = scan.information * update.constraints.projection;
  Eigen::Matrix<double, 6, ConsideredErrors::kSources> K;
  K << sensorErrors(beam_errors, update.T_world_scan.R), of_planes, M;
  const NavigationBy6 G = gainOf(update);
  const SixByNavigation MB = M * B;
  const NavigationBy6 with_n = productByTransposed(s.with_state, K);
  const NavigationBy6 kept_with_n = with_n - G * (MB * with_n);
  const Matrix6 cov_n = K * s.covariance * K.transpose() - scan.shared_noise;
  const NavigationMatrix half =
      productByTransposed(NavigationBy6(kept_with_n + 0.5 * G * cov_n), G);
  addition_ -= product(G, SixByNavigation(product(MB, addition_)));
  addition_ -= productByTransposed(NavigationBy6(productByTransposed(addition_, MB)), G);
  addition_ += half + half.transpose();
  considered_.update(G, MB, productByTransposed(s.with_considered, K));
  if (!update.gain.isZero(0.0)) considered_.takeEvidence(update, addition_);
  return mismatch;
}

void MapErrorModel::forgetMap()
{
  considered_.forgetPlanes();
}

StateMatrix MapErrorModel::addition() const
{
  StateMatrix of_state = StateMatrix::Zero();
  of_state.topLeftCorner<kNavigationDim, kNavigationDim>() =
      0.5 * (addition_ + addition_.transpose());
  return of_state;
}

StateMatrix MapErrorModel::additionAfter(const ErrorTransition& transition) const
{
  return transition.onBothSidesOf(addition());
}

void MapErrorModel::recordInsertion(
    std::uint32_t insertion, const InsertionError& error, const Pose& T_world_scan,
    const ScanPoseJacobian& by_state)
{
  const Matrix6 L = twistJacobian(T_world_scan);
  const SixByNavigation B = by_state.leftCols<kNavigationDim>();
  StateBy6 with_scan_pose = error.filter.lazyProduct(by_state.transpose());
  with_scan_pose.topRows<kNavigationDim>() += addition_.lazyProduct(B.transpose());
  const Matrix6 of_scan_pose = by_state.lazyProduct(with_scan_pose);
  const NavigationBy6 with_pose =
      product(withoutCalibration(by_state, of_scan_pose, with_scan_pose), Matrix6(L.transpose()));
  considered_.addPose(
      insertion, with_pose, twistCovariance(of_scan_pose + error.distortion, T_world_scan),
      T_world_scan.p, L * B);
}

}  // namespace fastlio
