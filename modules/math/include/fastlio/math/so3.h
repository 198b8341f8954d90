// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file so3.h The rotation group SO(3): exponential, logarithm and left Jacobian (A in the paper).
 */
#pragma once

#include <Eigen/Core>

namespace fastlio
{
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/** Orthogonal, right-handed, to within a thousandth: as far as files with few digits go. */
[[nodiscard]] bool isRotation(const Mat3& R);

/** Skew matrix [a]x, so that skew(a) * b = a x b. */
[[nodiscard]] Mat3 skew(const Vec3& a);

/** Rotation matrix of a rotation vector [rad] (Rodrigues); exact at zero. */
[[nodiscard]] Mat3 expSO3(const Vec3& rotation_vector);

/** Rotation vector [rad], norm in [0, pi], of a rotation matrix; safe near 0 and near pi. */
[[nodiscard]] Vec3 logSO3(const Mat3& R);

/** Left Jacobian A(u) of SO(3); its transpose is the right Jacobian. A(0) = I. */
[[nodiscard]] Mat3 leftJacobianSO3(const Vec3& u);

/** The rotation nearest to a matrix that drifted off SO(3) by rounding; of a sum of products a b^T,
 * the one that turns each b to its a best (Wahba's problem). */
[[nodiscard]] Mat3 normalizeRotation(const Mat3& R);

}  // namespace fastlio
