// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "insertion_weights.h"
#include <fastlio/errormodel/considered_errors.h>

#include <array>
#include <limits>

namespace fastlio
{
namespace
{
using Square6 = Eigen::Matrix<double, 6, 6>;

constexpr int kPlanes = kBeamErrors, kFirstGroup = kPlanes + 6;  // columns of c, after eta_b

// So many scans decide which planes are in view.
constexpr double kScansInView = 100.0;
// Planes that are out of view may come back: a group of them counts as much as one in view that has
// this part of the weight.
constexpr double kOutOfView = 0.05;

// Points match planes within the gate, which is a few centimetres wide. Planes that a scan finds
// along a direction with this part of the weight at least are as close to its pose.
constexpr double kMostDisagreement = 0.3;  // [m]
constexpr double kLeastShown = 0.1;
}  // namespace

ConsideredErrors::ConsideredErrors()
    : with_state_(decltype(with_state_)::Zero(kNavigationDim, kSize)),
      among_(Eigen::MatrixXd::Zero(kSize, kSize))
{
  among_.topLeftCorner<kFirstGroup, kFirstGroup>().setIdentity();
  groups_.reserve(kMaxGroups);
}

// By blocks of fixed size, whose products are faster where Eigen does not pack them first.
void ConsideredErrors::propagate(const ErrorTransition& transition)
{
  const Eigen::Matrix<double, kMotionDim, kNavigationDim> Phi =
      transition.by_state.leftCols<kNavigationDim>();
  for (int column = 0; column < kSize; column += 6)
  {
    const Eigen::Matrix<double, kMotionDim, 6> rows =
        Phi.lazyProduct(with_state_.middleCols<6>(column));
    with_state_.block<kMotionDim, 6>(0, column) = rows;
  }
}

void ConsideredErrors::correct(const NavigationBy6& K)
{
  for (int column = 0; column < kSize; column += 6)
  {
    const Square6 measured = with_state_.block<6, 6>(kVelocity, column);
    with_state_.middleCols<6>(column) -= K.lazyProduct(measured);
  }
}

void ConsideredErrors::update(
    const NavigationBy6& G, const Eigen::Matrix<double, 6, kNavigationDim>& MB, const BySix& cov_n)
{
  for (int column = 0; column < kSize; column += 6)
  {
    const Square6 seen =
        MB.lazyProduct(with_state_.middleCols<6>(column)) - cov_n.middleRows<6>(column).transpose();
    with_state_.middleCols<6>(column) -= G.lazyProduct(seen);
  }
}

void ConsideredErrors::renewPlanes(const Matrix6& R)
{
  with_state_.middleCols<6>(kPlanes) =
      with_state_.middleCols<6>(kPlanes).lazyProduct(R.transpose()).eval();
  for (int other = 0; other < kSize; other += 6)
  {
    if (other == kPlanes) continue;
    const Square6 with_other = R.lazyProduct(among_.block<6, 6>(kPlanes, other));
    among_.block<6, 6>(kPlanes, other) = with_other;
    among_.block<6, 6>(other, kPlanes) = with_other.transpose();
  }
  auto of_planes = among_.block<6, 6>(kPlanes, kPlanes);
  const Square6 known = of_planes - Square6::Identity();
  of_planes = Square6::Identity() + R * known * R.transpose();
}

ConsideredErrors::PlanesInView ConsideredErrors::planesInView(
    const Pose& T_world_scan, const GroupedMeasurements& scan)
{
  const Square6 mean = weighInsertions(scan, groups_);
  const Square6 L_inverse = twistJacobianInverse(T_world_scan);
  PlanesInView planes;
  planes.with_considered.setZero();
  planes.with_state.setZero();
  std::array<Square6, kMaxGroups> X;  // x = sum of X_i x_i
  for (std::size_t i = 0; i < groups_.size(); ++i)
  {
    Group& group = groups_[i];
    group.seen += (group.weights.all - group.seen) / kScansInView;
    if (group.weights.all == 0.0) continue;
    X[i] = mean * group.weights.shown * L_inverse;
    planes.with_considered += among_.middleCols<6>(group.column).lazyProduct(X[i].transpose());
    planes.with_state += with_state_.middleCols<6>(group.column).lazyProduct(X[i].transpose());
  }
  for (std::size_t i = 0; i < groups_.size(); ++i)
    if (groups_[i].weights.all > 0.0)
      planes.covariance += X[i] * planes.with_considered.middleRows<6>(groups_[i].column);
  return planes;
}

ConsideredErrors::ScanError ConsideredErrors::scanError(
    const PlanesInView& planes, const BeamPulls& of_beams, const Matrix6& of_planes,
    const Matrix6& M) const
{
  Eigen::Matrix<double, 6, kFirstGroup> C;
  C << of_beams, of_planes;
  const Square6 by_pose = M;
  ScanError n;
  n.with_considered = planes.with_considered.lazyProduct(by_pose.transpose());
  n.with_considered.noalias() += among_.leftCols<kFirstGroup>() * C.transpose();
  n.with_state = planes.with_state.lazyProduct(by_pose.transpose());
  n.with_state.noalias() += with_state_.leftCols<kFirstGroup>() * C.transpose();
  // cov(x, n) consists of cov(x) M^T and of cov(x, c) C^T.
  n.covariance = by_pose * planes.covariance * by_pose.transpose();
  n.covariance += by_pose * (C * planes.with_considered.topRows<kFirstGroup>()).transpose();
  n.covariance += C * n.with_considered.topRows<kFirstGroup>();
  return n;
}

void ConsideredErrors::takeEvidence(const LinearizedUpdate& update, NavigationMatrix& addition)
{
  const ScanConstraints& constraints = update.constraints;
  Square6 along = constraints.directions, measured = along;
  along.topRows<3>() /= constraints.lever_arm;
  measured.topRows<3>() *= constraints.lever_arm;
  const Square6 by_pose = measured.transpose() * twistJacobianInverse(update.T_world_scan);
  const Eigen::Matrix<double, 6, kNavigationDim> by_state =
      measured.transpose() * update.by_state.leftCols<kNavigationDim>();
  const NavigationMatrix filter = update.covariance.topLeftCorner<kNavigationDim, kNavigationDim>();
  std::array<Vector6, kMaxGroups> shown;  // about each direction
  Vector6 by_all = Vector6::Zero();
  for (std::size_t k = 0; k < groups_.size(); ++k)
  {
    shown[k] = (along.transpose() * groups_[k].weights.shown * along).diagonal();
    by_all += shown[k];
  }
  for (std::size_t k = 0; k < groups_.size(); ++k)
    for (int i = constraints.unconstrained; i < 6; ++i)
      if (shown[k][i] > kLeastShown * by_all[i])
        agree(
            {by_state.row(i).transpose(), -by_pose.row(i).transpose(), groups_[k].column}, filter,
            addition);
}

/** The difference between the pose and planes along a direction is at most kMostDisagreement. */
void ConsideredErrors::agree(
    const Difference& difference, const NavigationMatrix& filter, NavigationMatrix& addition)
{
  const auto& [by_state, by_pose, column] = difference;
  const Eigen::Matrix<double, kNavigationDim, 1> with_state =
      (filter + addition) * by_state + with_state_.middleCols<6>(column) * by_pose;
  const Eigen::Matrix<double, 6, 1> with_pose =
      with_state_.middleCols<6>(column).transpose() * by_state +
      among_.block<6, 6>(column, column) * by_pose;
  const double variance = by_state.dot(with_state) + by_pose.dot(with_pose);
  constexpr double kVariance = kMostDisagreement * kMostDisagreement;
  if (!(variance > kVariance)) return;
  const Eigen::Matrix<double, kSize, 1> with_considered =
      with_state_.transpose() * by_state + among_.middleCols<6>(column) * by_pose;
  // As a measurement of the difference would, after which this variance is left.
  const double part = (1.0 - kVariance / variance) / variance;
  addition -= part * with_state * with_state.transpose();
  with_state_.noalias() -= part * with_state * with_considered.transpose();
  among_.noalias() -= part * with_considered * with_considered.transpose();
}

/** Variance of the difference of their errors, as a motion of the place between [m^2]. */
double ConsideredErrors::varianceBetween(const Group& a, const Group& b) const
{
  const Square6 covariance =
      among_.block<6, 6>(a.column, a.column) + among_.block<6, 6>(b.column, b.column) -
      among_.block<6, 6>(a.column, b.column) - among_.block<6, 6>(b.column, a.column);
  Eigen::Matrix<double, 3, 6> motion;
  motion << -skew(0.5 * (a.place + b.place)), Mat3::Identity();
  return (motion * covariance * motion.transpose()).trace();
}

/** Puts those two neighbours together that differ least, and whose planes matter least. Their mean
 * counts what scans have seen of each. \return the column that is free now */
int ConsideredErrors::mergeMostAlike()
{
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < groups_.size(); ++i)
  {
    const Group &a = groups_[i], &b = groups_[i + 1];
    const double cost = varianceBetween(a, b) * (a.seen + b.seen + kOutOfView);
    if (!(cost < least)) continue;
    least = cost;
    best = i;
  }
  Group& into = groups_[best];
  const Group from = groups_[best + 1];
  const double sum = into.seen + from.seen;
  const double part = sum > 0.0 ? from.seen / sum : 0.5;
  const auto mix = [part](auto&& a, const auto& b) { a += part * (b - a); };
  mix(with_state_.middleCols<6>(into.column), with_state_.middleCols<6>(from.column));
  mix(among_.middleCols<6>(into.column), among_.middleCols<6>(from.column));
  mix(among_.middleRows<6>(into.column), among_.middleRows<6>(from.column));
  into.place += part * (from.place - into.place);
  into.seen = sum;
  groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  return from.column;
}

void ConsideredErrors::addPose(
    std::uint32_t insertion, const NavigationBy6& with_state, const TwistCovariance& covariance,
    const Vec3& place, const Eigen::Matrix<double, 6, kNavigationDim>& J)
{
  const auto groups = static_cast<int>(groups_.size());
  const int column = groups < kMaxGroups ? kFirstGroup + 6 * groups : mergeMostAlike();
  groups_.push_back({insertion, column, 1.0 / kScansInView, place, {}});
  for (int other = 0; other < kSize; other += 6)
  {
    const Square6 with_other = J.lazyProduct(with_state_.middleCols<6>(other));
    among_.block<6, 6>(column, other) = with_other;
    among_.block<6, 6>(other, column) = with_other.transpose();
  }
  among_.block<6, 6>(column, column) = covariance;
  with_state_.middleCols<6>(column) = with_state;
}

void ConsideredErrors::forgetPlanes()
{
  constexpr int kOfGroups = kSize - kFirstGroup;
  with_state_.rightCols<kSize - kPlanes>().setZero();
  among_.rightCols<kOfGroups>().setZero();
  among_.bottomRows<kOfGroups>().setZero();
  groups_.clear();
}

}  // namespace fastlio
