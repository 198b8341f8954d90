// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "square_root.h"
#include <fastlio/errormodel/map_error.h>

#include <Eigen/LU>

namespace fastlio
{
namespace
{
using AlignedMatrix6 = Eigen::Matrix<double, 6, 6>;
using StateBy6 = Eigen::Matrix<double, kStateDim, 6, Eigen::DontAlign>;
using SixByNavigation = Eigen::Matrix<double, 6, kNavigationDim>;

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
    const LinearizedUpdate& update, const GroupedMeasurements& scan, const BeamPulls& beams)
{
  if (scan.groups.empty()) return Matrix6::Zero();
  const Matrix6 of_planes = squareRoot(scan.plane_errors);
  considered_.renewPlanes(persistence(scan.plane_errors_before, of_planes, of_planes_));
  of_planes_ = of_planes;
  const ConsideredErrors::PlanesInView planes = considered_.planesInView(update.T_world_scan, scan);
  const SixByNavigation B = update.by_state.leftCols<kNavigationDim>();

  // Of B e - x. Where the planes are those of the scans just before, both have the same error.
  const Matrix6 common = B * planes.with_state;
  Matrix6 mismatch = productByTransposed(product(B, addition_), B) - common - common.transpose() +
                     planes.covariance;

  // e <- e - G (M B e - n)
  const Matrix6 M = scan.information * update.constraints.projection;
  const ConsideredErrors::ScanError n = considered_.scanError(planes, beams, of_planes, M);
  const NavigationBy6 G = gainOf(update);
  const SixByNavigation MB = M * B;
  const NavigationBy6 kept_with_n = n.with_state - G * (MB * n.with_state);
  const Matrix6 cov_n = n.covariance - scan.shared_noise;
  const NavigationMatrix half =
      productByTransposed(NavigationBy6(kept_with_n + 0.5 * G * cov_n), G);
  addition_ -= product(G, SixByNavigation(product(MB, addition_)));
  addition_ -= productByTransposed(NavigationBy6(productByTransposed(addition_, MB)), G);
  addition_ += half + half.transpose();
  considered_.update(G, MB, n.with_considered);
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
