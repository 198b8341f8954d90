// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "insertion_weights.h"
#include <fastlio/errormodel/map_error.h>
#include <fastlio/matching/degeneracy.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using AlignedMatrix6 = Eigen::Matrix<double, 6, 6>;
using AlignedStateMatrix = Eigen::Matrix<double, kStateDim, kStateDim>;
using AlignedStateBy6 = Eigen::Matrix<double, kStateDim, 6>;
using Aligned6ByState = Eigen::Matrix<double, 6, kStateDim>;

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

/** The gain with which the map's errors are passed on: they reach the scan pose and with it the
 * body's pose, while the calibration, which all scans determine together, is taken as it is. */
AlignedStateBy6 gainOf(const LinearizedUpdate& update)
{
  const Eigen::Matrix<double, 6, kStateDim> B = update.by_state;
  AlignedStateBy6 gain = update.gain;
  const AlignedMatrix6 scan_pose = product(B, gain);
  gain.topRows<6>() = AlignedMatrix6(B.leftCols<6>()).partialPivLu().solve(scan_pose);
  gain.bottomRows<kCalibrationDim>().setZero();
  return gain * update.constraints.projection.transpose();
}

/** I - K H = I - G (S B): what an update leaves of an error, as a change of rank six. */
struct Keeping
{
  AlignedStateBy6 G;
  Aligned6ByState SB;

  [[nodiscard]] AlignedStateBy6 times(const AlignedStateBy6& m) const
  {
    const AlignedMatrix6 seen = product(SB, m);
    return m - G * seen;
  }

  [[nodiscard]] AlignedStateMatrix onBothSidesOf(const AlignedStateMatrix& m) const
  {
    const AlignedStateMatrix left = m - product(G, product(SB, m));
    return left - productByTransposed(productByTransposed(left, SB), G);
  }

  /** Of the rows and columns of the pose. */
  [[nodiscard]] double poseTrace() const
  {
    return 6.0 - (G.topRows<6>() * SB.leftCols<6>()).trace();
  }
};

/** A square root of the covariance of q by errors of the sensor. It is taken in the axes of the
 * body: there it changes little from scan to scan, so that eta stays what it is in a turn. */
AlignedMatrix6 sensorErrors(const Matrix6& covariance, const Mat3& R_world_scan)
{
  AlignedMatrix6 turn = AlignedMatrix6::Identity();
  turn.bottomRightCorner<3, 3>() = R_world_scan;
  return turn * squareRoot(turn.transpose() * covariance * turn);
}

/** Goes on with Y = cov(e, eta) of one kind of error. \param kept what is left of Y
 * \param in what the scan adds to it
 * \return one half of what comes into cov(e); its transpose is the other */
AlignedStateMatrix addShared(
    Eigen::Ref<AlignedStateBy6> Y, const AlignedStateBy6& kept, const AlignedStateBy6& in)
{
  Y = kept + in;
  return productByTransposed(AlignedStateBy6(kept + 0.5 * in), in);
}

/** Covariance of q by the planes' own errors, in the scan pose's coordinates. */
AlignedMatrix6 planeErrors(const std::vector<PlaneGroup>& groups)
{
  AlignedMatrix6 Q = AlignedMatrix6::Zero();
  for (const PlaneGroup& group : groups)
    Q.noalias() += group.shared_variance * group.g * group.g.transpose();
  return Q;
}
}  // namespace

/** The error of the poses that created the planes in view: by_beams eta_b + others eta_a, of unit
 * vectors eta_b of the beams, and eta_a. */
struct MapErrorModel::CreatingErrors
{
  AlignedMatrix6 by_beams, others;
};

/** The planes that show one direction may be of other insertions than those that show another one:
 * walls of the start keep the position while new ground drifts in height. So the weights count
 * direction by direction. */
MapErrorModel::CreatingErrors MapErrorModel::creatingErrors(
    const LinearizedUpdate& update, const std::vector<PlaneGroup>& groups)
{
  const ShownDirections directions = shownDirections(update);
  weighInsertions(groups, directions, insertions_);
  const TwistCovariance mean = meanOfInsertions();
  Matrix6 scale = Matrix6::Identity();
  for (int i = 0; i < 6; ++i)
  {
    const Vector6 seen = directions.seen.row(i);
    double variance = varianceAlong(seen, i);
    const double of_mean = seen.dot(mean * seen);
    // Where nothing showed a weak direction for a while, all planes are wrong along it.
    if (isWeak(update.constraints, i)) variance = std::max(variance, of_mean);
    if (variance > 0.0 && of_mean > 0.0)
      scale += (std::sqrt(variance / of_mean) - 1.0) * directions.moved.col(i) * seen.transpose();
  }
  return {
      meanByDirection(directions, insertions_, &Insertion::by_beams),
      squareRoot(scale * mean * scale.transpose())};
}

/** Of the errors that are not of the beams: it is not known how far insertions share them, so they
 * count as the same for all. */
TwistCovariance MapErrorModel::meanOfInsertions() const
{
  TwistCovariance mean = TwistCovariance::Zero();
  TwistCovariance remembered = TwistCovariance::Zero();  // cov(own error, those of scans before)
  for (const Insertion& insertion : insertions_)
  {
    const double part = insertion.weights.all;
    remembered *= insertion.memory;
    if (part == 0.0) continue;  // most of them: long out of sight
    mean += part * (insertion.inherited + part * insertion.own + 2.0 * remembered);
    remembered += part * insertion.own;
  }
  return mean;
}

/** The same along a direction, with the weights of the planes that show it. */
double MapErrorModel::varianceAlong(const Vector6& seen, int direction) const
{
  double variance = 0.0, remembered = 0.0;
  for (const Insertion& insertion : insertions_)
  {
    const double part = insertion.weights.shown[direction];
    remembered *= insertion.memory;
    if (part == 0.0) continue;
    const double own = seen.dot(insertion.own * seen);
    variance += part * (seen.dot(insertion.inherited * seen) + part * own + 2.0 * remembered);
    remembered += part * own;
  }
  return variance;
}

void MapErrorModel::thinOut()
{
  for (std::size_t i = 2; i < insertions_.size(); i += 2)
    insertions_[i].memory *= insertions_[i - 1].memory;
  keepEverySecond(insertions_);
}

void MapErrorModel::propagate(const ErrorTransition& transition)
{
  addition_ = transition.onBothSidesOf(addition_);
  Y_planes_ = transition.times(Y_planes_);
  Y_beams_ = transition.times(Y_beams_);
  Y_poses_ = transition.times(Y_poses_);
}

void MapErrorModel::correct(const StateMatrix& kept)
{
  addition_ = transformedCovariance(kept, addition_);
  Y_planes_ = product(kept, Y_planes_);
  Y_beams_ = product(kept, Y_beams_);
  Y_poses_ = product(kept, Y_poses_);
}

/** Of B e - L^-1 a, with a the error of the creating poses. Where these are those of the scans just
 * before, both have the same error, and little is left of the difference. */
Matrix6 MapErrorModel::mismatch(
    const LinearizedUpdate& update, const CreatingErrors& creating) const
{
  const AlignedMatrix6 L_inverse = twistJacobianInverse(update.T_world_scan);
  const Aligned6ByState B = update.by_state;
  const AlignedMatrix6 by_beams = L_inverse * creating.by_beams,
                       others = L_inverse * creating.others;
  const AlignedMatrix6 common =
      productByTransposed(product(B, AlignedStateBy6(Y_poses_)), others) +
      productByTransposed(product(B, AlignedStateBy6(Y_beams_)), by_beams);
  return productByTransposed(product(B, AlignedStateMatrix(addition_)), B) - common -
         common.transpose() + productByTransposed(others, others) +
         productByTransposed(by_beams, by_beams);
}

Matrix6 MapErrorModel::update(
    const LinearizedUpdate& update, const GroupedMeasurements& scan, const Matrix6& beam_errors)
{
  if (scan.groups.empty()) return Matrix6::Zero();
  const AlignedMatrix6 L = twistJacobian(update.T_world_scan);
  const AlignedMatrix6 L_inverse = twistJacobianInverse(update.T_world_scan);
  const AlignedMatrix6 M = L_inverse.transpose() * scan.information * L_inverse;
  const AlignedMatrix6 C_planes =
      squareRoot(L_inverse.transpose() * planeErrors(scan.groups) * L_inverse);
  const CreatingErrors creating = creatingErrors(update, scan.groups);
  Matrix6 of_innovation = mismatch(update, creating);

  const AlignedStateBy6 gain = gainOf(update);
  const Keeping keep{gain, scan.information * (update.constraints.projection * update.by_state)};
  memory_ *= std::clamp(keep.poseTrace() / 6.0, 0.0, 1.0);
  const AlignedStateBy6 G = gain * L.transpose();
  const AlignedStateBy6 by_beams =
      gain * sensorErrors(beam_errors, update.T_world_scan.R) + G * (M * creating.by_beams);
  const AlignedStateMatrix half =
      addShared(Y_planes_, scan.persistence * keep.times(Y_planes_), G * C_planes) +
      addShared(Y_beams_, keep.times(Y_beams_), by_beams) +
      addShared(Y_poses_, keep.times(Y_poses_), G * (M * creating.others)) -
      productByTransposed(AlignedStateBy6(0.5 * gain * scan.shared_noise), gain);
  addition_ = keep.onBothSidesOf(addition_) + half + half.transpose();
  return of_innovation;
}

void MapErrorModel::forgetMap()
{
  Y_planes_.setZero();
  Y_poses_.setZero();
  insertions_.clear();
}

StateMatrix MapErrorModel::addition() const
{
  return 0.5 * (addition_ + addition_.transpose());
}

StateMatrix MapErrorModel::additionAfter(const ErrorTransition& transition) const
{
  return transition.onBothSidesOf(addition());
}

void MapErrorModel::recordInsertion(
    std::uint32_t scan, const InsertionError& pose_error, const Pose& T_world_scan,
    const ScanPoseJacobian& by_state)
{
  if (insertions_.size() >= kMaxInsertions) thinOut();
  const Matrix6 by_beams = product(Aligned6ByState(by_state), AlignedStateBy6(Y_beams_));
  // The noise that is taken off, and rounding, must not let the beams explain more than there is.
  const Matrix6 others = positivePart(pose_error.inherited - by_beams * by_beams.transpose());
  insertions_.push_back(
      {scan,
       twistCovariance(others, T_world_scan),
       twistCovariance(pose_error.own, T_world_scan),
       twistJacobian(T_world_scan) * by_beams,
       memory_,
       {}});
  memory_ = 1.0;
}

}  // namespace fastlio
