// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/start_in_map.h>

#include <cmath>

namespace fastlio
{
namespace
{
// The map's vertical is that of an earlier start [rad]; 0.5 deg.
constexpr double kMapTiltStd = 0.008726646259971648;

/** The rotation about the vertical that brings the attitude nearest to the one wanted. */
double headingTo(const Mat3& wanted, const Mat3& R)
{
  const Mat3 turn = wanted * R.transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}
}  // namespace

FilterState standingAt(const FilterState& state, const Pose& T_map_imu)
{
  const Mat3 turn = T_map_imu.R * state.x.R.transpose();
  FilterState moved = state;
  moved.x.R = T_map_imu.R;
  moved.x.p = T_map_imu.p;
  moved.x.v = turn * state.x.v;
  moved.x.g = turn * state.x.g;
  StateMatrix T = StateMatrix::Identity();
  for (const int block :
       {static_cast<int>(kPosition), static_cast<int>(kVelocity), static_cast<int>(kGravity)})
    T.block<3, 3>(block, block) = turn;
  moved.P = T * state.P * T.transpose();
  return moved;
}

FilterState placedInMap(const FilterState& start, const Pose& T_map_imu)
{
  const Mat3 turn = expSO3({0.0, 0.0, headingTo(T_map_imu.R, start.x.R)});
  return standingAt(start, {turn * start.x.R, T_map_imu.p + turn * start.x.p});
}

FilterState withUncertainPlace(
    const FilterState& state, const InitializationOptions& parameters, double scale)
{
  FilterState uncertain = state;
  Eigen::Matrix<double, kStateDim, 3, Eigen::DontAlign> J =
      Eigen::Matrix<double, kStateDim, 3>::Zero();
  J.block<3, 3>(kAttitude, 0) = state.x.R.transpose();
  J.block<3, 3>(kVelocity, 0) = -skew(state.x.v);
  J.block<3, 3>(kGravity, 0) = -skew(state.x.g);
  const Vec3 std(kMapTiltStd, kMapTiltStd, parameters.pose_yaw_std);
  const Mat3 turning = (scale * std.cwiseAbs2()).asDiagonal();
  uncertain.P += J * turning * J.transpose();
  uncertain.P.block<3, 3>(kPosition, kPosition).diagonal().array() +=
      scale * std::pow(parameters.pose_position_std, 2);
  return uncertain;
}

std::vector<Pose> posesAround(const Pose& pose, const InitializationOptions& parameters)
{
  std::vector<Pose> poses = {pose};
  for (const int turn : {0, -1, 1, -2, 2})
    for (const int x : {0, -1, 1})
      for (const int y : {0, -1, 1})
        poses.push_back(
            {expSO3({0.0, 0.0, turn * parameters.pose_yaw_std}) * pose.R,
             pose.p + parameters.pose_position_std * Vec3(x, y, 0.0)});
  return poses;
}

}  // namespace fastlio
