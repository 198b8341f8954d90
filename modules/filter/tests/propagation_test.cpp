// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_problems.h"
#include <fastlio/filter/propagation.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
/** A state, an input and a period. */
struct Case
{
  NavState x;
  Vec3 gyro;
  Vec3 accel;
  double dt;
};

/** Rates from rest to far above those of any sensor, periods from 1 kHz to 10 Hz. */
std::vector<Case> cases(unsigned seed)
{
  testing::Random random(seed);
  std::vector<Case> all;
  for (const double rate : {0.0, 1e-6, 1e-2, 1.0, 20.0})
    for (const double dt : {0.001, 0.005, 0.1})
      for (int i = 0; i < 5; ++i)
        all.push_back({random.state(), rate * random.axis(), random.vector(10.0), dt});
  // Measured rate exactly the bias: the angle is zero and A(0) = I.
  Case still = all.front();
  still.gyro = still.x.gyro_bias;
  all.push_back(still);
  return all;
}

FilterState propagated(
    const FilterState& s, const Vec3& gyro, const Vec3& accel, double dt, const ImuNoise& noise)
{
  return propagate({s, {}}, gyro, accel, dt, noise).state;
}

ErrorTransition chained(
    const ErrorTransition& before, const NavState& x, const Vec3& gyro, const Vec3& accel,
    double dt)
{
  return propagate({{x, StateMatrix::Zero()}, before}, gyro, accel, dt, ImuNoise{}).transition;
}

/** Q of eq. 8 for one sample: density^2 / dt per axis. */
NoiseVector discreteVariances(const ImuNoise& noise, double dt)
{
  NoiseVector q;
  q.segment<3>(0).setConstant(noise.gyro_noise_density * noise.gyro_noise_density / dt);
  q.segment<3>(3).setConstant(noise.accel_noise_density * noise.accel_noise_density / dt);
  q.segment<3>(6).setConstant(noise.gyro_bias_walk * noise.gyro_bias_walk / dt);
  q.segment<3>(9).setConstant(noise.accel_bias_walk * noise.accel_bias_walk / dt);
  return q;
}

TEST(Propagation, MeanFollowsTheProcessModel)
{
  NavState x;
  x.v = Vec3(1.0, 2.0, 3.0);
  x.gyro_bias = Vec3(0.01, 0.0, 0.0);
  x.accel_bias = Vec3(0.0, 0.1, 0.0);
  x.g = Vec3(0.0, 0.0, -9.8);
  const NavState y = propagateMean(x, Vec3(0.01, 0.0, 1.0), Vec3(1.0, 0.1, 9.8), 0.1);
  EXPECT_LT((y.R - expSO3(Vec3(0.0, 0.0, 0.1))).norm(), 1e-15);
  // Accelerated by 1 m/s^2 along the x axis as it lies in the middle of the step.
  const Vec3 a(std::cos(0.05), std::sin(0.05), 0.0);
  EXPECT_LT((y.p - (Vec3(0.1, 0.2, 0.3) + 0.005 * a)).norm(), 1e-15);
  EXPECT_LT((y.v - (Vec3(1.0, 2.0, 3.0) + 0.1 * a)).norm(), 1e-14);
  EXPECT_EQ(y.gyro_bias, x.gyro_bias);
  EXPECT_EQ(y.accel_bias, x.accel_bias);
  EXPECT_EQ(y.g, x.g);
}

TEST(Propagation, RestingSensorStaysAtRest)
{
  testing::Random random(11);
  NavState x = random.state();
  x.v.setZero();
  const Vec3 accel = x.accel_bias - x.R.transpose() * x.g;
  NavState y = x;
  for (int i = 0; i < 2000; ++i)
    y = propagateMean(y, x.gyro_bias, accel, 0.005);
  EXPECT_LT(boxminus(y, x).norm(), 1e-9);
}

/** Distance [m] and difference of velocities [m/s] from the exact motion, turning at w and pushed
 * by a in the body frame for a second in n steps. */
std::pair<double, double> errorsAfterOneSecond(const Vec3& w, const Vec3& a, int n)
{
  const auto run = [&](int steps)
  {
    NavState x;
    x.g.setZero();
    for (int i = 0; i < steps; ++i)
      x = propagateMean(x, w, a, 1.0 / steps);
    return x;
  };
  const NavState coarse = run(n), exact = run(1000 * n);
  return {(coarse.p - exact.p).norm(), (coarse.v - exact.v).norm()};
}

// A scheme of first order lags half a step behind, as if the clocks differed by so much.
TEST(Propagation, IsOfSecondOrder)
{
  const Vec3 w(0.5, -1.0, 2.0), a(1.0, 5.0, 9.8);
  const auto [p_50, v_50] = errorsAfterOneSecond(w, a, 50);
  const auto [p_200, v_200] = errorsAfterOneSecond(w, a, 200);
  EXPECT_NEAR(p_50 / p_200, 16.0, 1.0);
  EXPECT_NEAR(v_50 / v_200, 16.0, 1.0);
  EXPECT_LT(p_200, 1e-4);
  EXPECT_LT(v_200, 1e-4);
}

TEST(Propagation, FxIsTheDerivativeByTheErrorState)
{
  constexpr double kStep = 1e-6;
  for (const Case& c : cases(12))
  {
    StateMatrix numeric;
    for (int i = 0; i < kStateDim; ++i)
    {
      const StateVector e = kStep * StateVector::Unit(i);
      const NavState y = propagateMean(c.x, c.gyro, c.accel, c.dt);
      const NavState plus = propagateMean(boxplus(c.x, e), c.gyro, c.accel, c.dt);
      const NavState minus = propagateMean(boxplus(c.x, -e), c.gyro, c.accel, c.dt);
      numeric.col(i) = (boxminus(plus, y) - boxminus(minus, y)) / (2.0 * kStep);
    }
    const StateMatrix Fx = processJacobians(c.x, c.gyro, c.accel, c.dt).Fx;
    EXPECT_LT((Fx - numeric).cwiseAbs().maxCoeff(), 5e-8) << "dt " << c.dt;
  }
}

TEST(Propagation, FwIsTheDerivativeByTheNoise)
{
  constexpr double kStep = 1e-5;
  for (const Case& c : cases(13))
  {
    NoiseJacobian numeric;
    const NavState y = propagateMean(c.x, c.gyro, c.accel, c.dt);
    for (int i = 0; i < kNoiseDim; ++i)
    {
      const NoiseVector e = kStep * NoiseVector::Unit(i);
      const NavState plus = propagateMean(c.x, c.gyro, c.accel, c.dt, e);
      const NavState minus = propagateMean(c.x, c.gyro, c.accel, c.dt, -e);
      numeric.col(i) = (boxminus(plus, y) - boxminus(minus, y)) / (2.0 * kStep);
    }
    const NoiseJacobian Fw = processJacobians(c.x, c.gyro, c.accel, c.dt).Fw;
    EXPECT_LT((Fw - numeric).cwiseAbs().maxCoeff(), 1e-8) << "dt " << c.dt;
  }
}

TEST(Propagation, CovarianceIsEquation8)
{
  testing::Random random(14);
  const ImuNoise noise{0.3, 0.7, 0.05, 0.09};
  for (const Case& c : cases(15))
  {
    const FilterState s{c.x, random.covariance(0.3, 100.0)};
    const auto [Fx, Fw] = processJacobians(c.x, c.gyro, c.accel, c.dt);
    const Eigen::MatrixXd noises = Eigen::MatrixXd(discreteVariances(noise, c.dt).asDiagonal());
    const StateMatrix expected = testing::onBothSides(Fx, s.P) + testing::onBothSides(Fw, noises);
    const FilterState out = propagated(s, c.gyro, c.accel, c.dt, noise);
    EXPECT_LT((out.P - expected).norm(), 1e-13 * expected.norm());
    EXPECT_EQ((out.P - out.P.transpose()).norm(), 0.0);
    EXPECT_EQ(boxminus(out.x, propagateMean(c.x, c.gyro, c.accel, c.dt)).tail<15>().norm(), 0.0);
  }
}

TEST(Propagation, NoiseGrowsWithTimeWhateverTheSampleRate)
{
  // A random walk of density s has the variance s^2 T after T seconds, at 100 Hz as at 1 kHz.
  const ImuNoise noise{1e-3, 1e-2, 1e-4, 1e-3};
  const NavState rest;
  for (const int rate : {100, 1000})
  {
    FilterState s{rest, StateMatrix::Zero()};
    for (int i = 0; i < 2 * rate; ++i)
      s = propagated(s, Vec3::Zero(), Vec3(0.0, 0.0, 9.81), 1.0 / rate, noise);
    const StateVector variance = s.P.diagonal();
    EXPECT_NEAR(variance[kGyroBias], 2.0 * 1e-8, 1e-16) << rate;
    EXPECT_NEAR(variance[kAccelBias], 2.0 * 1e-6, 1e-14) << rate;
    // Attitude about the vertical: white rate noise and the integrated bias walk, s^2 T^3 / 3.
    EXPECT_NEAR(variance[kAttitude + 2], 2.0 * 1e-6 + 1e-8 * 8.0 / 3.0, 1e-9) << rate;
    // Vertical velocity at rest: white noise and bias walk likewise.
    EXPECT_NEAR(variance[kVelocity + 2], 2.0 * 1e-4 + 1e-6 * 8.0 / 3.0, 1e-7) << rate;
  }
}

TEST(Propagation, CovarianceStaysSymmetricAndPositiveWithoutUpdates)
{
  testing::Random random(16);
  FilterState s{NavState{}, StateMatrix::Zero()};
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 accel = Vec3(0.0, 0.0, 9.81) + random.vector(1.0);
    s = propagated(s, random.vector(1.0), accel, 0.005, ImuNoise{});
  }
  EXPECT_TRUE(isFinite(s.x));
  EXPECT_LT((s.x.R * s.x.R.transpose() - Mat3::Identity()).norm(), 1e-11);
  EXPECT_EQ((s.P - s.P.transpose()).norm(), 0.0);
  EXPECT_GT(testing::eigenvaluesOf(s.P).minCoeff(), -1e-12 * s.P.norm());
}

TEST(Propagation, AStepOfNoLengthChangesNothing)
{
  testing::Random random(17);
  const FilterState s{random.state(), random.covariance(1.0, 10.0)};
  const FilterState out = propagated(s, random.vector(), random.vector(), 0.0, ImuNoise{});
  EXPECT_EQ(out.P, s.P);
  EXPECT_EQ(out.x.R, s.x.R);
  EXPECT_EQ(out.x.p, s.x.p);
}

TEST(Propagation, AStepBackInTimeIsRefused)
{
  const FilterState s;
  for (const double dt : {-0.005, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(
        (void)propagated(s, Vec3::Zero(), Vec3::Zero(), dt, ImuNoise{}), std::invalid_argument);
}

TEST(Propagation, TransitionIsTheProductOfTheJacobians)
{
  testing::Random random(19);
  StateMatrix Phi = StateMatrix::Identity();
  ErrorTransition transition;
  for (const Case& step : cases(19))
  {
    transition = chained(transition, step.x, step.gyro, step.accel, step.dt);
    Phi = processJacobians(step.x, step.gyro, step.accel, step.dt).Fx * Phi;
  }
  const StateMatrix P = random.covariance(1.0, 10.0);
  const double size = Phi.norm();
  EXPECT_LT((transition.times(StateMatrix(StateMatrix::Identity())) - Phi).norm(), 1e-12 * size);
  const StateMatrix expected = testing::onBothSides(Phi, P);
  EXPECT_LT((transition.onBothSidesOf(P) - expected).norm(), 1e-12 * expected.norm());
}

/** Two steps through readings of a sensor whose matrices are I + error, or as if they were I. */
NavState motionWith(
    const std::array<Case, 2>& steps, const Mat3& gyro_error, const Mat3& accel_error)
{
  NavState x = steps[0].x;
  for (const Case& step : steps)
  {
    const Vec3 rate = (Mat3::Identity() + gyro_error).inverse() * (step.gyro - x.gyro_bias);
    const Vec3 force = (Mat3::Identity() + accel_error).inverse() * (step.accel - x.accel_bias);
    x = propagateMean(x, rate + x.gyro_bias, force + x.accel_bias, step.dt);
  }
  return x;
}

TEST(Propagation, SensitivityIsTheDerivativeByTheMatricesOfTheSensor)
{
  constexpr double kStep = 1e-5;
  const std::vector<Case> all = cases(18);
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
  {
    const std::array<Case, 2> steps{all[i], all[i + 1]};
    const NavState taken_for_true = motionWith(steps, Mat3::Zero(), Mat3::Zero());
    ErrorTransition transition;
    NavState x = steps[0].x;
    for (const Case& step : steps)
    {
      transition = chained(transition, x, step.gyro, step.accel, step.dt);
      x = propagateMean(x, step.gyro, step.accel, step.dt);
    }
    for (int k = 0; k < 18; ++k)
    {
      const auto errorWith = [&](double value)
      {
        Mat3 error = Mat3::Zero();
        error(k % 3, k % 9 / 3) = value;
        const NavState truth =
            k < 9 ? motionWith(steps, error, Mat3::Zero()) : motionWith(steps, Mat3::Zero(), error);
        return boxminus(taken_for_true, truth);
      };
      const StateVector numeric = (errorWith(kStep) - errorWith(-kStep)) / (2.0 * kStep);
      const double size = 1.0 + numeric.norm();
      EXPECT_LT((numeric.head<9>() - transition.by_inertial.col(k)).norm(), 1e-4 * size)
          << i << ", " << k;
    }
  }
}
}  // namespace
}  // namespace fastlio
