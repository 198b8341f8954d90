// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "start_in_map.h"

#include <cmath>

namespace fastlio
{
namespace
{
/** The rotation about the vertical that brings the attitude nearest to the one wanted. */
double headingTo(const Mat3& wanted, const Mat3& R)
{
  const Mat3 turn = wanted * R.transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

/** Everything that has a direction in the world, turned about the vertical through the IMU. */
NavState turned(NavState x, double heading)
{
  const Mat3 turn = expSO3({0.0, 0.0, heading});
  x.R = turn * x.R;
  x.v = turn * x.v;
  x.g = turn * x.g;
  return x;
}
}  // namespace

FilterState placedInMap(
    const FilterState& start, const Pose& T_map_imu, const InitializationParameters& parameters)
{
  FilterState state = start;
  const double heading = headingTo(T_map_imu.R, start.x.R);
  state.x = turned(start.x, heading);
  state.x.p = T_map_imu.p + expSO3({0.0, 0.0, heading}) * start.x.p;
  const Mat3 turn = expSO3({0.0, 0.0, heading});
  StateMatrix T = StateMatrix::Identity();
  for (const int block :
       {static_cast<int>(kPosition), static_cast<int>(kVelocity), static_cast<int>(kGravity)})
    T.block<3, 3>(block, block) = turn;
  state.P = T * start.P * T.transpose();

  // An error of the map's axes turns attitude, velocity and gravity together.
  Eigen::Matrix<double, kStateDim, 3, Eigen::DontAlign> J =
      Eigen::Matrix<double, kStateDim, 3>::Zero();
  J.block<3, 3>(kAttitude, 0) = state.x.R.transpose();
  J.block<3, 3>(kVelocity, 0) = -skew(state.x.v);
  J.block<3, 3>(kGravity, 0) = -skew(state.x.g);
  const Vec3 std(parameters.pose_tilt_std, parameters.pose_tilt_std, parameters.pose_yaw_std);
  const Mat3 turning = std.cwiseAbs2().asDiagonal();
  state.P += J * turning * J.transpose();
  state.P.block<3, 3>(kPosition, kPosition).diagonal().array() +=
      std::pow(parameters.pose_position_std, 2);
  return state;
}

std::vector<FilterState> candidatesAround(
    const FilterState& state, const InitializationParameters& parameters)
{
  std::vector<FilterState> candidates = {state};
  for (const int turn : {0, -1, 1, -2, 2})
    for (const int x : {0, -1, 1})
      for (const int y : {0, -1, 1})
      {
        FilterState candidate = state;
        candidate.x = turned(state.x, turn * parameters.pose_yaw_std);
        candidate.x.p += parameters.pose_position_std * Vec3(x, y, 0.0);
        candidates.push_back(candidate);
      }
  return candidates;
}

}  // namespace fastlio
