// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file random_problems.h Reproducible random states and covariances for the filter's tests.
 *
 * The formulas of the tests are of matrices of dynamic size. The compiler needs more time
 * for those of 25 x 25 numbers, as Eigen unrolls their loops. */
#pragma once

#include <fastlio/filter/state.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <random>

namespace fastlio::testing
{
/** Source of random numbers that is the same on every run. */
class Random
{
 public:
  explicit Random(unsigned seed) : rng_(seed) {}

  double normal() { return normal_(rng_); }
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }

  Vec3 vector(double sigma = 1.0) { return sigma * Vec3(normal(), normal(), normal()); }
  Vec3 axis() { return vector().normalized(); }

  StateVector stateVector(double sigma)
  {
    StateVector dx;
    for (int i = 0; i < kStateDim; ++i)
      dx[i] = sigma * normal();
    return dx;
  }

  NavState state()
  {
    NavState x;
    x.R = expSO3(uniform(0.0, 3.1) * axis());
    x.p = vector(50.0);
    x.v = vector(5.0);
    x.gyro_bias = vector(0.05);
    x.accel_bias = vector(0.3);
    x.g = 9.81 * axis();
    x.extrinsic_correction = {expSO3(vector(0.1)), vector(0.1)};
    x.time_offset = 0.01 * normal();
    return x;
  }

  /** Full covariance with the given standard deviation along random axes, the largest being
   * \a spread times the smallest. */
  StateMatrix covariance(double sigma, double spread)
  {
    Eigen::MatrixXd m(kStateDim, kStateDim);
    for (int i = 0; i < kStateDim; ++i)
      m.col(i) = stateVector(1.0);
    const Eigen::MatrixXd Q = m.householderQr().householderQ();
    Eigen::VectorXd variances(kStateDim);
    for (int i = 0; i < kStateDim; ++i)
    {
      const double s = sigma * std::pow(spread, uniform(-0.5, 0.5));
      variances[i] = s * s;
    }
    const Eigen::MatrixXd P = Q * variances.asDiagonal() * Q.transpose();
    return 0.5 * (P + P.transpose());
  }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/** Eigenvalues of a symmetric covariance. */
inline Eigen::VectorXd eigenvaluesOf(const Eigen::MatrixXd& P)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P, Eigen::EigenvaluesOnly).eigenvalues();
}

/** A P A^T. */
inline Eigen::MatrixXd onBothSides(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P)
{
  return A * P * A.transpose();
}

/** e^T P^-1 e. */
inline double weightedSquare(const Eigen::VectorXd& e, const Eigen::MatrixXd& P)
{
  return e.dot(P.inverse() * e);
}
}  // namespace fastlio::testing
