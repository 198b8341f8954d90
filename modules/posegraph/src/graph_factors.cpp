// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/posegraph/graph_factors.h>

#include <Eigen/Geometry>
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

Across acrossOf(const Vec3& direction)
{
  Eigen::Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  Across across;
  across.col(0) = direction.cross(Vec3(Vec3::Unit(least))).normalized();
  across.col(1) = direction.cross(Vec3(across.col(0)));
  return across;
}

TiltError errorOf(const TiltFactor& factor, const Pose& node, const Vec3& up)
{
  const Across across = acrossOf(factor.up);
  const Vec3 seen = node.R.transpose() * up;
  TiltError error;
  error.value = across.transpose() * seen;
  error.by_attitude = across.transpose() * skew(seen);
  error.by_up = across.transpose() * node.R.transpose() * acrossOf(up);
  if (factor.by_sensor.cols() > 0) error.by_sensor = across.transpose() * factor.by_sensor;
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
