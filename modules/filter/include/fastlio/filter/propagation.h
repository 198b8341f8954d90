// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file propagation.h Forward propagation of state and covariance (eq. 2-8). */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/filter/state.h>
#include <fastlio/math/linear_algebra.h>

namespace fastlio
{
/** Noise vector w = (n_w, n_a, n_bw, n_ba). */
constexpr int kNoiseDim = 12;
using NoiseJacobian = Eigen::Matrix<double, kStateDim, kNoiseDim, Eigen::DontAlign>;
using NoiseVector = Eigen::Matrix<double, kNoiseDim, 1, Eigen::DontAlign>;

/** Fx and Fw of eq. 7. */
struct ProcessJacobians
{
  StateMatrix Fx;
  NoiseJacobian Fw;
};

/** x [+] dt f(x, u, w) of eq. 2-3, with the noise w for tests (zero in the filter, eq. 4).
 *
 * Of second order in dt: the specific force is turned to the world with the attitude in the middle
 * of the step, and the position moves with the mean of the velocities at both ends. The scheme as
 * printed, of first order, lags by dt / 2.
 * \param gyro w_m [rad/s]
 * \param accel a_m [m/s^2]
 * \param dt [s] */
[[nodiscard]] NavState propagateMean(
    const NavState& x, const Vec3& gyro, const Vec3& accel, double dt,
    const NoiseVector& w = NoiseVector::Zero());

/** The Jacobians of eq. 7, of propagateMean(), at x with input (gyro, accel) over dt [s]. */
[[nodiscard]] ProcessJacobians processJacobians(
    const NavState& x, const Vec3& gyro, const Vec3& accel, double dt);

/** Attitude, position and velocity: a step changes the error of these alone. */
constexpr int kMotionDim = 9;

/** The first rows of a product of Fx; the others are those of the identity. */
using MotionRows = Eigen::Matrix<double, kMotionDim, kStateDim, Eigen::DontAlign>;

/** Derivative of attitude, position and velocity by the errors of the inertial sensor's matrices,
 * A_g and A_a by columns: w_m = A_g w + b_w, a_m = A_a a + b_a with A = I + error (scale,
 * misalignment). The filter takes a reading for true, so what the matrices add to it acts as a bias
 * that the filter does not know. */
using InertialSensitivity = Eigen::Matrix<double, kMotionDim, 18, Eigen::DontAlign>;

/** How some steps pass errors on: e <- Phi e + Psi theta. */
struct ErrorTransition
{
  MotionRows by_state = MotionRows::Identity();                   //!< Phi
  InertialSensitivity by_inertial = InertialSensitivity::Zero();  //!< Psi

  /** Phi m, for a matrix with a row per element of the error. */
  template <typename Matrix>
  [[nodiscard]] Matrix times(Matrix m) const
  {
    m.template topRows<kMotionDim>() = product(by_state, m);
    return m;
  }
  /** Phi P Phi^T of a symmetric P. */
  [[nodiscard]] StateMatrix onBothSidesOf(const StateMatrix& P) const;
};

/** A propagated state, and how the way to it passes errors on. */
struct Prediction
{
  FilterState state;
  ErrorTransition transition;
};

/** One more step of eq. 4 and eq. 8: P = Fx P Fx^T + Fw Q Fw^T, evaluated block by block and
 * symmetric to the bit. The discrete noise of a zero-order-hold sample is density^2 / dt per axis.
 * \param gyro w_m [rad/s]
 * \param accel a_m [m/s^2]
 * \param dt [s], 0 changes nothing
 * \throw std::invalid_argument when dt is negative or not a number */
[[nodiscard]] Prediction propagate(
    const Prediction& before, const Vec3& gyro, const Vec3& accel, double dt,
    const ImuNoise& noise);

}  // namespace fastlio
