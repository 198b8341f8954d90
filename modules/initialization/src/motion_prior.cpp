// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/propagation.h>
#include <fastlio/initialization/motion_prior.h>
#include <fastlio/initialization/static_initializer.h>
#include <fastlio/math/time.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <cstdint>

namespace fastlio
{
namespace
{
// How far the map that the first scan founds may be off as a whole ...
constexpr double kFirstMapPositionStd = 0.05;  // [m]
constexpr double kFirstMapAttitudeStd = 0.01;  // [rad]
// ... and the poses of the scans that join it in the window.
constexpr double kWindowMapPositionStd = 0.02;    // [m]
constexpr double kWindowMapAttitudeStd = 0.0015;  // [rad]
// Where a drone sees little at 7 m/s, velocity and gravity are wrong by more than their covariance
// says for another second.
constexpr std::int64_t kSettlingTime_ns = 2'000'000'000;

/** Where the world is fixed: pose exact, velocity and biases as wide as configured, gravity known
 * by its magnitude only. */
StateMatrix openPrior(const NavState& x, const PriorWidth& width, const InitializationOptions& p)
{
  StateMatrix P = StateMatrix::Zero();
  P.block<3, 3>(kVelocity, kVelocity).diagonal().setConstant(std::pow(width.velocity, 2));
  P.block<3, 3>(kGyroBias, kGyroBias).diagonal().setConstant(std::pow(p.motion_gyro_bias_std, 2));
  P.block<3, 3>(kAccelBias, kAccelBias).diagonal().setConstant(std::pow(p.accel_bias_std, 2));
  const Vec3 down = x.g.normalized();
  const Mat3 radial = down * down.transpose();
  P.block<3, 3>(kGravity, kGravity) =
      std::pow(kGravityStd, 2) * radial +
      std::pow(p.gravity * width.tilt, 2) * (Mat3::Identity() - radial);
  return P;
}

/** P_0 = Phi^-1 P_1 Phi^-T, Phi from the state x0 through the inputs. */
StateMatrix covarianceBefore(const StateMatrix& P1, NavState x0, const Inputs& inputs)
{
  using Square = Eigen::Matrix<double, kStateDim, kStateDim>;
  Square Phi = Square::Identity();
  for (std::size_t i = 0; i < inputs.samples.size(); ++i)
  {
    const double dt = inputs.duration(i);
    const ImuSample& u = inputs.samples[i];
    Phi = product(processJacobians(x0, u.gyro, u.accel, dt).Fx, Phi);
    x0 = propagateMean(x0, u.gyro, u.accel, dt);
  }
  const Eigen::PartialPivLU<Square> lu(Phi);
  const Square half = lu.solve(Square(P1));
  const Square P0 = lu.solve(Square(half.transpose()));
  return 0.5 * (P0 + P0.transpose());
}

StateMatrix poseVariances(double attitude_std, double position_std)
{
  StateMatrix P = StateMatrix::Zero();
  P.diagonal().segment<3>(kAttitude).setConstant(attitude_std * attitude_std);
  P.diagonal().segment<3>(kPosition).setConstant(position_std * position_std);
  return P;
}

/** The integral of the specific force, turned to the first frame by the gyro [m/s]. */
Vec3 integratedForce(const Inputs& inputs)
{
  Mat3 R = Mat3::Identity();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < inputs.samples.size(); ++i)
  {
    const double dt = inputs.duration(i);
    sum += dt * (R * inputs.samples[i].accel);
    R = R * expSO3(dt * inputs.samples[i].gyro);
  }
  return sum;
}
}  // namespace

double Inputs::duration(std::size_t i) const
{
  const std::int64_t stop_ns = i + 1 < samples.size() ? samples[i + 1].stamp_ns : end_ns;
  return toSeconds(stop_ns - samples[i].stamp_ns);
}

Inputs inputsOf(const ImuBuffer& imu, std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold)
{
  Inputs inputs;
  imu.inputsBetween(begin_ns, end_ns, hold, inputs.samples);
  inputs.end_ns = end_ns;
  return inputs;
}

NavState startState(
    const Vec3& g_imu, const Vec3& v_imu, const Vec3& gyro_bias, const InitializationOptions& p)
{
  NavState x;
  const Vec3 down = g_imu.normalized();
  if (p.align_with_gravity) x.R = rotationBetween(-down, Vec3::UnitZ());
  x.g = x.R * (p.gravity * down);
  x.v = x.R * v_imu;
  x.gyro_bias = gyro_bias;
  return x;
}

double meanForce(const Inputs& inputs)
{
  double duration = 0.0;
  for (std::size_t i = 0; i < inputs.samples.size(); ++i)
    duration += inputs.duration(i);
  return integratedForce(inputs).norm() / duration;
}

NavState firstGuess(const Inputs& inputs, const InitializationOptions& p)
{
  return startState(-integratedForce(inputs), Vec3::Zero(), Vec3::Zero(), p);
}

NavState propagatedBack(NavState x, const Inputs& inputs)
{
  for (std::size_t i = inputs.samples.size(); i-- > 0;)
  {
    const double dt = inputs.duration(i);
    const ImuSample& u = inputs.samples[i];
    const Vec3 rate = u.gyro - x.gyro_bias;
    const Mat3 R_middle = x.R * expSO3(-0.5 * dt * rate);
    const Vec3 acceleration = R_middle * (u.accel - x.accel_bias) + x.g;
    x.p -= dt * (x.v - 0.5 * dt * acceleration);
    x.v -= dt * acceleration;
    x.R = x.R * expSO3(-dt * rate);
  }
  return x;
}

double unexplainedRate(
    const StampedPose& first, const StampedPose& last, const Inputs& inputs, const Vec3& gyro_bias)
{
  NavState x;
  x.R = last.T_world_body.R;
  x.gyro_bias = gyro_bias;
  const Mat3 R_first = propagatedBack(x, inputs).R;
  return logSO3(R_first.transpose() * first.T_world_body.R).norm() /
         toSeconds(last.stamp_ns - first.stamp_ns);
}

FilterState startPrior(
    const NavState& x0, const PriorWidth& width, const Inputs& first_scan,
    const InitializationOptions& p)
{
  return {x0, covarianceBefore(openPrior(x0, width, p), x0, first_scan)};
}

MotionWindow motionWindowUntil(std::int64_t end_ns, int target_points)
{
  MotionWindow window;
  window.end_ns = end_ns;
  window.settled_ns = end_ns + kSettlingTime_ns;
  window.target_points = target_points;
  window.covariance_after_first_scan = poseVariances(kFirstMapAttitudeStd, kFirstMapPositionStd);
  window.insertion_covariance =
      poseVariances(kWindowMapAttitudeStd, kWindowMapPositionStd).topLeftCorner<6, 6>();
  return window;
}

}  // namespace fastlio
