// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file random_problems.h Reproducible random states and covariances for the filter's tests. */
#pragma once

#include <fastlio/filter/state.h>

#include <Eigen/Eigenvalues>
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
    StateMatrix m;
    for (int i = 0; i < kStateDim; ++i)
      m.col(i) = stateVector(1.0);
    const Eigen::Matrix<double, kStateDim, kStateDim> Q = m.householderQr().householderQ();
    StateVector variances;
    for (int i = 0; i < kStateDim; ++i)
    {
      const double s = sigma * std::pow(spread, uniform(-0.5, 0.5));
      variances[i] = s * s;
    }
    const StateMatrix P = Q * variances.asDiagonal() * Q.transpose();
    return 0.5 * (P + P.transpose());
  }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/** Eigenvalues of a symmetric covariance (Eigen's solver takes no unaligned matrices). */
inline StateVector eigenvaluesOf(const StateMatrix& P)
{
  using Aligned = Eigen::Matrix<double, kStateDim, kStateDim>;
  return Eigen::SelfAdjointEigenSolver<Aligned>(Aligned(P), Eigen::EigenvaluesOnly).eigenvalues();
}
}  // namespace fastlio::testing
