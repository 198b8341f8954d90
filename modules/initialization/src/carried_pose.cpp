// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/carried_pose.h>
#include <fastlio/math/linear_algebra.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kLongestExtrapolation = 1.0;  // [s]
// Of the motion while nothing was measured: a platform that accelerates and turns as it likes.
constexpr double kUnseenAccelStd = 1.0;                // [m/s^2]
constexpr double kUnseenGyroStd = 0.3490658503988659;  // [rad/s]; 20 deg/s
// Beyond, more uncertainty says no more.
constexpr double kLargestPositionStd = 50.0;  // [m]
constexpr double kLargestHeadingStd = 1.5;    // [rad]

/** Turns the blocks of the error state that are in the world frame. */
StateMatrix turned(const StateMatrix& P, const Mat3& W)
{
  StateMatrix T = StateMatrix::Identity();
  for (const int block : {kPosition, kVelocity, kGravity})
    T.block<3, 3>(block, block) = W;
  const StateMatrix P_turned = transformedCovariance(T, P);
  return 0.5 * (P_turned + P_turned.transpose());
}

/** No knowledge shared with other blocks, and this covariance. */
void replaceBlock(StateMatrix& P, int block, const Mat3& covariance)
{
  P.middleRows<3>(block).setZero();
  P.middleCols<3>(block).setZero();
  P.block<3, 3>(block, block) = covariance;
}

/** The world of the start in the carried one: headings agree as well as they can. */
Mat3 worldRotation(const NavState& start, const NavState& carried)
{
  const Mat3 R = carried.R * start.R.transpose();
  return rotationBetween(R * start.g, carried.g) * R;
}
}  // namespace

CarriedPose carriedOver(const FilterState& last, double unknown_s)
{
  CarriedPose carried;
  carried.x = last.x;
  carried.P = last.P;
  const double t = std::max(0.0, unknown_s);
  const double extrapolated_s = std::min(t, kLongestExtrapolation);
  carried.x.p += extrapolated_s * last.x.v;
  const double position_std = std::min(
      kLargestPositionStd, std::min(0.5 * kUnseenAccelStd * t * t, (1.0 + last.x.v.norm()) * t));
  const double heading_std = std::min(kLargestHeadingStd, kUnseenGyroStd * t);
  carried.P.diagonal().segment<3>(kPosition).array() += position_std * position_std;
  // A platform that turns leaves the straight way to a side, by the mean of the angle.
  const Vec3 aside = 0.5 * heading_std * extrapolated_s * last.x.v.cross(last.x.g.normalized());
  carried.P.block<3, 3>(kPosition, kPosition) +=
      aside * aside.transpose() +
      extrapolated_s * extrapolated_s * last.P.block<3, 3>(kVelocity, kVelocity);
  carried.P.diagonal().segment<3>(kAttitude).array() += heading_std * heading_std;
  return carried;
}

FilterState startInCarriedWorld(const FilterState& start, const CarriedPose& carried)
{
  const Mat3 W = worldRotation(start.x, carried.x);
  FilterState s;
  s.x = start.x;
  s.x.R = normalizeRotation(W * start.x.R);
  s.x.p = carried.x.p;
  s.x.v = W * start.x.v;
  s.x.g = carried.x.g;
  s.x.extrinsic_correction = carried.x.extrinsic_correction;
  s.x.time_offset = carried.x.time_offset;
  s.P = turned(start.P, W);

  // The uncertainty of gravity's direction at the start is now the uncertainty of the attitude's
  // tilt.
  const Mat3 g_covariance = s.P.block<3, 3>(kGravity, kGravity);
  const double g2 = carried.x.g.squaredNorm();
  replaceBlock(s.P, kGravity, carried.P.block<3, 3>(kGravity, kGravity));
  const Mat3 to_body = s.x.R.transpose();
  const Mat3 g_cross = skew(carried.x.g);
  Mat3 tilt = g_cross * g_covariance * g_cross.transpose() / (g2 * g2);
  const Vec3 down = carried.x.g.normalized();
  // The carried attitude error is in the axes of the carried body, which may be tilted otherwise.
  const Vec3 axis = carried.x.R.transpose() * down;
  tilt += axis.dot(carried.P.block<3, 3>(kAttitude, kAttitude) * axis) * down * down.transpose();
  s.P.block<3, 3>(kAttitude, kAttitude) += to_body * tilt * to_body.transpose();
  s.P.block<3, 3>(kPosition, kPosition) += carried.P.block<3, 3>(kPosition, kPosition);
  for (int i = kExtrinsicRotation; i < kStateDim; ++i)
    s.P(i, i) = carried.P(i, i);
  return s;
}

}  // namespace fastlio
