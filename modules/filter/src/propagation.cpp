// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/propagation.h>

#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
/** The blocks of eq. 7 that are neither zero nor a multiple of the identity. Noise enters as the
 * biases do (n_w beside b_w, n_a beside b_a), so Fw has no blocks of its own; the position takes
 * half of what the velocity takes, times dt. */
struct ProcessBlocks
{
  Mat3 attitude_attitude;    //!< Exp(-w dt)
  Mat3 attitude_gyro_bias;   //!< -A(w dt)^T dt
  Mat3 velocity_attitude;    //!< -R [Exp(h) a]x dt, h = w dt / 2
  Mat3 velocity_gyro_bias;   //!< R Exp(h) [a]x A(h)^T dt^2 / 2
  Mat3 velocity_accel_bias;  //!< -R Exp(h) dt
};

ProcessBlocks processBlocks(const NavState& x, const Vec3& gyro, const Vec3& accel, double dt)
{
  const Vec3 angle = (gyro - x.gyro_bias) * dt, half = 0.5 * angle;
  const Vec3 a = accel - x.accel_bias;
  const Mat3 R_half = expSO3(half);
  ProcessBlocks b;
  b.attitude_attitude = expSO3(-angle);
  b.attitude_gyro_bias = -dt * leftJacobianSO3(angle).transpose();
  b.velocity_attitude.noalias() = -dt * x.R * skew(R_half * a);
  b.velocity_accel_bias.noalias() = -dt * x.R * R_half;
  const Mat3 turned = skew(a).lazyProduct(leftJacobianSO3(half).transpose());
  b.velocity_gyro_bias = -0.5 * dt * b.velocity_accel_bias.lazyProduct(turned);
  return b;
}

using AlignedMotionRows = Eigen::Matrix<double, kMotionDim, kStateDim>;
using MotionSquare = Eigen::Matrix<double, kMotionDim, kMotionDim>;

/** The first nine rows of Fx P. */
AlignedMotionRows leftMultiply(const ProcessBlocks& F, const StateMatrix& P, double dt)
{
  using Rows = Eigen::Matrix<double, 3, kStateDim>;
  const Rows gained = dt * P.middleRows<3>(kGravity) +
                      F.velocity_attitude.lazyProduct(P.middleRows<3>(kAttitude)) +
                      F.velocity_gyro_bias.lazyProduct(P.middleRows<3>(kGyroBias)) +
                      F.velocity_accel_bias.lazyProduct(P.middleRows<3>(kAccelBias));
  AlignedMotionRows m;
  m.middleRows<3>(kAttitude).noalias() =
      F.attitude_attitude.lazyProduct(P.middleRows<3>(kAttitude)) +
      F.attitude_gyro_bias.lazyProduct(P.middleRows<3>(kGyroBias));
  m.middleRows<3>(kPosition) =
      P.middleRows<3>(kPosition) + dt * P.middleRows<3>(kVelocity) + (0.5 * dt) * gained;
  m.middleRows<3>(kVelocity) = P.middleRows<3>(kVelocity) + gained;
  return m;
}

/** The first nine columns of (rows of Fx P) Fx^T. */
MotionSquare rightMultiply(const AlignedMotionRows& m, const ProcessBlocks& F, double dt)
{
  using Columns = Eigen::Matrix<double, kMotionDim, 3>;
  const Columns gained = dt * m.middleCols<3>(kGravity) +
                         m.middleCols<3>(kAttitude).lazyProduct(F.velocity_attitude.transpose()) +
                         m.middleCols<3>(kGyroBias).lazyProduct(F.velocity_gyro_bias.transpose()) +
                         m.middleCols<3>(kAccelBias).lazyProduct(F.velocity_accel_bias.transpose());
  MotionSquare s;
  s.middleCols<3>(kAttitude).noalias() =
      m.middleCols<3>(kAttitude).lazyProduct(F.attitude_attitude.transpose()) +
      m.middleCols<3>(kGyroBias).lazyProduct(F.attitude_gyro_bias.transpose());
  s.middleCols<3>(kPosition) =
      m.middleCols<3>(kPosition) + dt * m.middleCols<3>(kVelocity) + (0.5 * dt) * gained;
  s.middleCols<3>(kVelocity) = m.middleCols<3>(kVelocity) + gained;
  return s;
}

/** P + Fw Q Fw^T. A sample is the mean over its period dt, so white noise of density s has the
 * variance s^2 / dt in it; Fw carries dt itself, which leaves s^2 dt. */
void addNoise(StateMatrix& P, const ProcessBlocks& F, const ImuNoise& noise, double dt)
{
  const auto square = [](double s) { return s * s; };
  Eigen::Matrix<double, kMotionDim, 3> by_gyro;
  by_gyro.middleRows<3>(kAttitude) = F.attitude_gyro_bias;
  by_gyro.middleRows<3>(kPosition) = (0.5 * dt) * F.velocity_gyro_bias;
  by_gyro.middleRows<3>(kVelocity) = F.velocity_gyro_bias;
  const MotionSquare spread =
      square(noise.gyro_noise_density) / dt * by_gyro.lazyProduct(by_gyro.transpose());
  // In which order a compiler multiplies is its own affair; P stays symmetric to the bit.
  P.topLeftCorner<kMotionDim, kMotionDim>() += 0.5 * (spread + spread.transpose());
  // (R Exp(h) dt) (R Exp(h) dt)^T / dt = I dt
  const double accel = square(noise.accel_noise_density) * dt;
  P.diagonal().segment<3>(kVelocity).array() += accel;
  P.diagonal().segment<3>(kPosition).array() += 0.25 * dt * dt * accel;
  P.block<3, 3>(kPosition, kVelocity).diagonal().array() += 0.5 * dt * accel;
  P.block<3, 3>(kVelocity, kPosition).diagonal().array() += 0.5 * dt * accel;
  P.diagonal().segment<3>(kGyroBias).array() += square(noise.gyro_bias_walk) * dt;
  P.diagonal().segment<3>(kAccelBias).array() += square(noise.accel_bias_walk) * dt;
}

/** Phi P Phi^T, of which only the first nine rows and columns differ from P, from those rows of
 * Phi P and from \a motion, the corner of Phi P Phi^T. */
StateMatrix assembled(
    const StateMatrix& P, const AlignedMotionRows& rows, const MotionSquare& motion)
{
  constexpr int kRest = kStateDim - kMotionDim;
  StateMatrix out;
  out.topLeftCorner<kMotionDim, kMotionDim>() = 0.5 * (motion + motion.transpose());
  out.topRightCorner<kMotionDim, kRest>() = rows.rightCols<kRest>();
  out.bottomLeftCorner<kRest, kMotionDim>() = rows.rightCols<kRest>().transpose();
  out.bottomRightCorner<kRest, kRest>() = P.bottomRightCorner<kRest, kRest>();
  return out;
}

/** Eq. 8 from the blocks of Fx. */
StateMatrix propagateCovariance(
    const StateMatrix& P, const ProcessBlocks& F, double dt, const ImuNoise& noise)
{
  const AlignedMotionRows rows = leftMultiply(F, P, dt);
  StateMatrix out = assembled(P, rows, rightMultiply(rows, F, dt));
  addNoise(out, F, noise, dt);
  return out;
}

/** Fx Phi, its first nine rows. */
MotionRows chained(const MotionRows& Phi, const ProcessBlocks& F, double dt)
{
  using Rows = Eigen::Matrix<double, 3, kStateDim>;
  const auto attitude = Phi.middleRows<3>(kAttitude);
  Rows turned = F.attitude_attitude.lazyProduct(attitude);
  turned.middleCols<3>(kGyroBias) += F.attitude_gyro_bias;
  Rows gained = F.velocity_attitude.lazyProduct(attitude);
  gained.middleCols<3>(kGyroBias) += F.velocity_gyro_bias;
  gained.middleCols<3>(kAccelBias) += F.velocity_accel_bias;
  gained.middleCols<3>(kGravity).diagonal().array() += dt;
  MotionRows next;
  next.middleRows<3>(kAttitude) = turned;
  next.middleRows<3>(kPosition) =
      Phi.middleRows<3>(kPosition) + dt * Phi.middleRows<3>(kVelocity) + (0.5 * dt) * gained;
  next.middleRows<3>(kVelocity) = Phi.middleRows<3>(kVelocity) + gained;
  return next;
}

/** The sensitivity after one more step, with rate and specific force free of their biases. */
InertialSensitivity chained(
    const InertialSensitivity& Psi, const ProcessBlocks& F, const Vec3& rate, const Vec3& force,
    double dt)
{
  using Rows = Eigen::Matrix<double, 3, 18>;
  const auto attitude = Psi.middleRows<3>(kAttitude);
  Rows turned = F.attitude_attitude.lazyProduct(attitude);
  Rows gained = F.velocity_attitude.lazyProduct(attitude);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    turned.middleCols<3>(3 * axis) -= rate[axis] * F.attitude_gyro_bias;
    gained.middleCols<3>(3 * axis) -= rate[axis] * F.velocity_gyro_bias;
    gained.middleCols<3>(9 + 3 * axis) -= force[axis] * F.velocity_accel_bias;
  }
  InertialSensitivity next;
  next.middleRows<3>(kAttitude) = turned;
  next.middleRows<3>(kPosition) =
      Psi.middleRows<3>(kPosition) + dt * Psi.middleRows<3>(kVelocity) + (0.5 * dt) * gained;
  next.middleRows<3>(kVelocity) = Psi.middleRows<3>(kVelocity) + gained;
  return next;
}
}  // namespace

// Eq. 2-3: x [+] dt f(x, u, w), of second order: with the attitude in the middle of the step, and
// the position with the mean velocity.
NavState propagateMean(
    const NavState& x, const Vec3& gyro, const Vec3& accel, double dt, const NoiseVector& w)
{
  const Vec3 rate = gyro - x.gyro_bias - w.segment<3>(0);
  const Mat3 R_middle = x.R * expSO3(0.5 * dt * rate);
  const Vec3 acceleration = R_middle * (accel - x.accel_bias - w.segment<3>(3)) + x.g;
  StateVector f = StateVector::Zero();
  f.segment<3>(kAttitude) = rate;
  f.segment<3>(kPosition) = x.v + 0.5 * dt * acceleration;
  f.segment<3>(kVelocity) = acceleration;
  f.segment<3>(kGyroBias) = w.segment<3>(6);
  f.segment<3>(kAccelBias) = w.segment<3>(9);
  return boxplus(x, dt * f);
}

// Eq. 7: Fx and Fw, written out in full.
ProcessJacobians processJacobians(const NavState& x, const Vec3& gyro, const Vec3& accel, double dt)
{
  const ProcessBlocks b = processBlocks(x, gyro, accel, dt);
  const Mat3 I_dt = dt * Mat3::Identity();
  ProcessJacobians j{StateMatrix::Identity(), NoiseJacobian::Zero()};
  j.Fx.block<3, 3>(kAttitude, kAttitude) = b.attitude_attitude;
  j.Fx.block<3, 3>(kAttitude, kGyroBias) = b.attitude_gyro_bias;
  j.Fx.block<3, 3>(kPosition, kVelocity) = I_dt;
  const auto gains = [&j, dt](StateBlock of, const Mat3& block)
  {
    j.Fx.block<3, 3>(kVelocity, of) = block;
    j.Fx.block<3, 3>(kPosition, of) = 0.5 * dt * block;
  };
  gains(kAttitude, b.velocity_attitude);
  gains(kGyroBias, b.velocity_gyro_bias);
  gains(kAccelBias, b.velocity_accel_bias);
  gains(kGravity, I_dt);
  j.Fw.topLeftCorner<kMotionDim, 3>() = j.Fx.block<kMotionDim, 3>(0, kGyroBias);
  j.Fw.block<kMotionDim, 3>(0, 3) = j.Fx.block<kMotionDim, 3>(0, kAccelBias);
  j.Fw.block<3, 3>(kGyroBias, 6) = I_dt;
  j.Fw.block<3, 3>(kAccelBias, 9) = I_dt;
  return j;
}

StateMatrix ErrorTransition::onBothSidesOf(const StateMatrix& P) const
{
  const AlignedMotionRows rows = product(by_state, P);
  return assembled(P, rows, productByTransposed(rows, by_state));
}

// Eq. 4 (mean, w = 0) and eq. 8 (covariance).
Prediction propagate(
    const Prediction& before, const Vec3& gyro, const Vec3& accel, double dt, const ImuNoise& noise)
{
  if (dt == 0.0) return before;
  if (!(dt > 0.0))
  {
    throw std::invalid_argument(
        "propagate: the time step is " + std::to_string(dt) +
        " s but must not be negative; sort the inertial samples by stamp");
  }
  const NavState& x = before.state.x;
  const ProcessBlocks F = processBlocks(x, gyro, accel, dt);
  return {
      {propagateMean(x, gyro, accel, dt), propagateCovariance(before.state.P, F, dt, noise)},
      {chained(before.transition.by_state, F, dt),
       chained(before.transition.by_inertial, F, gyro - x.gyro_bias, accel - x.accel_bias, dt)}};
}

}  // namespace fastlio
