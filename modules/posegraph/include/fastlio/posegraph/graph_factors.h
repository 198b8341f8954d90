// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file graph_factors.h Errors of the measurements of a pose graph, with Jacobians (internal). */
#pragma once

#include <fastlio/posegraph/pose_graph.h>

namespace fastlio
{
/** Inverse of the right Jacobian of SO(3): Log(Exp(u) Exp(d)) = u + J d. */
[[nodiscard]] Mat3 inverseRightJacobianSO3(const Vec3& u);

struct EdgeError
{
  Vector6 value;       //!< attitude in the frame of b, position in that of a
  Matrix6 by_a, by_b;  //!< by the errors of the nodes
};
[[nodiscard]] EdgeError errorOf(const RelativePose& measured, const Pose& a, const Pose& b);

/** Two directions across a direction, and across each other. */
using Across = Eigen::Matrix<double, 3, 2>;
[[nodiscard]] Across acrossOf(const Vec3& direction);

struct TiltError
{
  Eigen::Vector2d value;  //!< across the measured direction; without errors of the sensor
  Eigen::Matrix<double, 2, 3> by_attitude;
  Eigen::Matrix2d by_up;      //!< by a step of it along acrossOf(up)
  Eigen::MatrixXd by_sensor;  //!< 2 x n; empty as that of the factor
};
/** \param up against gravity in the world */
[[nodiscard]] TiltError errorOf(const TiltFactor& factor, const Pose& node, const Vec3& up);

struct PositionError
{
  Vec3 value;
  Eigen::Matrix<double, 3, 6> by_node, by_earth;
};
[[nodiscard]] PositionError errorOf(
    const PositionFactor& factor, const Pose& node, const Pose& T_earth_world);

}  // namespace fastlio
