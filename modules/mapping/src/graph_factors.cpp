// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "graph_factors.h"

#include <Eigen/LU>

namespace fastlio
{
Mat3 inverseRightJacobianSO3(const Vec3& u)
{
  return Mat3(leftJacobianSO3(u).transpose()).inverse();
}

EdgeError errorOf(const RelativePose& measured, const Pose& a, const Pose& b)
{
  EdgeError error;
  const Pose T_a_b = a.inverse() * b;
  const Vec3 turn = logSO3(measured.T_a_b.R.transpose() * T_a_b.R);
  error.value << turn, T_a_b.p - measured.T_a_b.p;
  const Mat3 J = inverseRightJacobianSO3(turn);
  error.by_a.setZero();
  error.by_a.topLeftCorner<3, 3>() = -J * T_a_b.R.transpose();
  error.by_a.bottomLeftCorner<3, 3>() = skew(T_a_b.p);
  error.by_a.bottomRightCorner<3, 3>() = -a.R.transpose();
  error.by_b.setZero();
  error.by_b.topLeftCorner<3, 3>() = J;
  error.by_b.bottomRightCorner<3, 3>() = a.R.transpose();
  return error;
}

TiltError errorOf(const TiltFactor& factor, const Pose& node)
{
  // The heading that both have in common is taken out: R = Rz(heading) R_measured Exp(...) would
  // leave the same tilt. Gravity's direction in the body frame determines the tilt alone.
  const Vec3 up = Vec3::UnitZ();
  const Vec3 measured = factor.R_world_body.transpose() * up;
  const Vec3 seen = node.R * measured;  // where the node has what was up
  TiltError error;
  // About the world's axes: up x seen.
  error.value << -seen.y(), seen.x();
  const Mat3 by_attitude = -node.R * skew(measured);
  error.by_attitude.row(0) = -by_attitude.row(1);
  error.by_attitude.row(1) = by_attitude.row(0);
  return error;
}

PositionError errorOf(const PositionFactor& factor, const Pose& node, const Pose& T_earth_world)
{
  PositionError error;
  const Vec3 in_world = node * factor.lever;
  error.value = T_earth_world * in_world - factor.position;
  error.by_node.leftCols<3>() = -T_earth_world.R * node.R * skew(factor.lever);
  error.by_node.rightCols<3>() = T_earth_world.R;
  error.by_earth.leftCols<3>() = -T_earth_world.R * skew(in_world);
  error.by_earth.rightCols<3>() = Mat3::Identity();
  return error;
}

}  // namespace fastlio
