// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file state.h The state on the manifold SO(3) x R^15, extended by the calibration of the LiDAR
 * on SO(3) x R^4, and its boxplus/boxminus (section III of the paper). */
#pragma once

#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/pose.h>

namespace fastlio
{
/** Size of the paper's error state (dtheta, dp, dv, db_w, db_a, dg). */
constexpr int kNavigationDim = 18;

/** Size of the calibration's error state (dphi_c, dp_c, dtau). */
constexpr int kCalibrationDim = 7;

/** Size of the whole error state. */
constexpr int kStateDim = kNavigationDim + kCalibrationDim;

/** First index of each block of the error state: 3-vectors but for the time offset, a scalar. */
enum StateBlock : int
{
  kAttitude = 0,
  kPosition = 3,
  kVelocity = 6,
  kGyroBias = 9,
  kAccelBias = 12,
  kGravity = 15,
  kExtrinsicRotation = 18,
  kExtrinsicTranslation = 21,
  kTimeOffset = 24
};

// Unaligned, so that size and alignment of public types do not depend on compiler flags.
using StateVector = Eigen::Matrix<double, kStateDim, 1, Eigen::DontAlign>;
using StateMatrix = Eigen::Matrix<double, kStateDim, kStateDim, Eigen::DontAlign>;

/** The navigation state x = (R, p, v, b_w, b_a, g) of eq. 1 and the calibration of the LiDAR, which
 * stays as it is unless its covariance allows it to move. */
struct NavState
{
  Mat3 R = Mat3::Identity();       //!< attitude: rotation from the IMU to the world frame
  Vec3 p = Vec3::Zero();           //!< position of the IMU in the world frame [m]
  Vec3 v = Vec3::Zero();           //!< velocity in the world frame [m/s]
  Vec3 gyro_bias = Vec3::Zero();   //!< b_w [rad/s]
  Vec3 accel_bias = Vec3::Zero();  //!< b_a [m/s^2]
  Vec3 g = {0.0, 0.0, -9.81};      //!< gravity in the world frame [m/s^2]
  Pose extrinsic_correction;       //!< C: the extrinsic is C T_imu_lidar, C in the IMU frame
  double time_offset = 0.0;        //!< tau, added to the stamps of the LiDAR [s]

  [[nodiscard]] Pose pose() const { return {R, p}; }
  /** Direction of gravity in the IMU frame. */
  [[nodiscard]] Vec3 down() const { return R.transpose() * g.normalized(); }
};

/** x [+] dx: rotations R Exp(dtheta), plain sums for the rest. */
[[nodiscard]] NavState boxplus(const NavState& x, const StateVector& dx);

/** a [-] b, so that boxplus(b, boxminus(a, b)) = a: rotations Log(R_b^T R_a). */
[[nodiscard]] StateVector boxminus(const NavState& a, const NavState& b);

/** True when every component is a finite number. */
[[nodiscard]] bool isFinite(const NavState& x);

/** Mean and covariance of the filter; the covariance is of the error state in the order of
 * StateBlock, attitude in the IMU frame (right perturbation), the rest in the world frame. */
struct FilterState
{
  NavState x;
  StateMatrix P = StateMatrix::Zero();
};

}  // namespace fastlio
