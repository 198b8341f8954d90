// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How uncertain a prediction is after an outage, and what a found pose makes of it.

#include <fastlio/matching/pose_search.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <limits>

namespace fastlio
{
namespace
{
// Half a percent of scale and a third of a degree of misalignment of gravity, as MEMS sensors have.
constexpr double kUnmodelledAcceleration = 0.05;  // [m/s^2]
// Of its variance. What is constant in the body turns with it, but gravity's part stays.
constexpr double kConstantPart = 0.75;
// Shorter times add nothing that the noise of the inertial sensor does not cover.
constexpr double kShortTime = 0.5;  // [s]
// Of a pose along a motion that nothing determines.
constexpr double kUnknownAngleStd = 3.0, kUnknownPositionStd = 1000.0;  // [rad], [m]
// A start farther off than this may end in a wrong minimum.
constexpr double kPullInStd = 0.05;  // [m]
constexpr double kFarPoints = 10.0;  // [m]
// How well a search knows the pose that the scan is then matched from.
constexpr double kFoundAngleStd = 0.01, kFoundPositionStd = 0.03;  // [rad], [m]

/** Covariance of position and velocity, per axis, by an acceleration that nobody measures. */
struct BlindError
{
  double pp = 0.0, pv = 0.0, vv = 0.0;
};

/** A part of it by a constant acceleration, the rest by a white one that moves the position as far.
 */
BlindError blindError(double t)
{
  if (t < kShortTime) return {};
  const double q = kUnmodelledAcceleration * kUnmodelledAcceleration;
  const double white = 1.0 - kConstantPart;
  const double pv = kConstantPart / 2.0 + white * 3.0 / 8.0;
  const double vv = kConstantPart + white * 3.0 / 4.0;
  return {q * t * t * t * t / 4.0, q * t * t * t * pv, q * t * t * vv};
}

}  // namespace

Vec3 positionStd(const FilterState& predicted)
{
  const Vec3 variance = predicted.P.diagonal().segment<3>(kPosition);
  if (!variance.allFinite()) return Vec3::Constant(std::numeric_limits<double>::infinity());
  return variance.cwiseMax(0.0).cwiseSqrt();
}

void considerUnmodelledAcceleration(FilterState& predicted, double blind_s, double before_s)
{
  if (blind_s < kShortTime) return;
  const BlindError now = blindError(blind_s), before = blindError(before_s);
  const double dt = blind_s - before_s;
  const double pp = now.pp - (before.pp + 2.0 * dt * before.pv + dt * dt * before.vv);
  const double pv = now.pv - (before.pv + dt * before.vv);
  StateMatrix& P = predicted.P;
  P.diagonal().segment<3>(kPosition).array() += pp;
  P.diagonal().segment<3>(kVelocity).array() += now.vv - before.vv;
  P.block<3, 3>(kPosition, kVelocity).diagonal().array() += pv;
  P.block<3, 3>(kVelocity, kPosition).diagonal().array() += pv;
}

bool isOutage(double blind_s)
{
  return blind_s >= kShortTime;
}

bool needsPoseSearch(const FilterState& predicted, double blind_s)
{
  return isOutage(blind_s) &&
         predicted.P.diagonal().segment<3>(kPosition).maxCoeff() > kPullInStd * kPullInStd;
}

bool needsPullIn(const FilterState& predicted, bool degenerate)
{
  const auto variance = [&](int block)
  {
    const Mat3 P = predicted.P.block<3, 3>(block, block);
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(P, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[degenerate ? 1 : 2];
  };
  const double turned = kFarPoints * kFarPoints * variance(kAttitude);
  return variance(kPosition) + turned > kPullInStd * kPullInStd;
}

FilterState withIndependentPosition(const FilterState& predicted, const Mat3& directions)
{
  const Mat3 others = Mat3::Identity() - directions;
  const Mat3 position = predicted.P.block<3, 3>(kPosition, kPosition);
  FilterState state = predicted;
  StateMatrix& P = state.P;
  P.middleRows<3>(kPosition) = others * predicted.P.middleRows<3>(kPosition);
  P.middleCols<3>(kPosition) = P.middleRows<3>(kPosition).transpose();
  P.block<3, 3>(kPosition, kPosition) =
      others * position * others.transpose() + directions * position * directions.transpose();
  return state;
}

FilterState correctedByPose(
    const FilterState& predicted, const Pose& T_world_imu,
    const std::vector<MotionDirection>& unknown)
{
  NavState found = predicted.x;
  found.R = T_world_imu.R;
  found.p = T_world_imu.p;
  Eigen::Matrix<double, 6, 6> S = predicted.P.topLeftCorner<6, 6>();
  S.diagonal().head<3>().array() += kFoundAngleStd * kFoundAngleStd;
  S.diagonal().tail<3>().array() += kFoundPositionStd * kFoundPositionStd;
  for (const MotionDirection& motion : unknown)
  {
    const double std = motion.is_rotation ? kUnknownAngleStd : kUnknownPositionStd;
    const int block = motion.is_rotation ? 0 : 3;
    S.block<3, 3>(block, block) += std * std * motion.axis * motion.axis.transpose();
  }
  const Eigen::Matrix<double, kStateDim, 6> PHt = predicted.P.leftCols<6>();
  const Eigen::Matrix<double, 6, kStateDim> Kt = S.llt().solve(PHt.transpose());
  const StateVector difference = boxminus(found, predicted.x);
  FilterState corrected;
  corrected.x = boxplus(predicted.x, Kt.transpose() * difference.head<6>());
  const StateMatrix removed = PHt * Kt;
  corrected.P = predicted.P - 0.5 * (removed + removed.transpose());
  return corrected;
}

}  // namespace fastlio
