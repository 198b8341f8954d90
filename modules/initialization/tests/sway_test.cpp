// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A start at rest of somebody who stands and sways.

#include "samples_at_rest.h"
#include <fastlio/initialization/static_initializer.h>
#include <fastlio/math/time.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** Somebody who stands: a lean about y and a way along x, once in one to three seconds. */
struct Standing
{
  explicit Standing(Random& random)
      : rate(6.28 / (2.0 + random.uniform(-1.0, 1.0))), phase(random.uniform(-3.14, 3.14))
  {
  }
  [[nodiscard]] double angle(double t) const { return kLean * std::sin(rate * t + phase); }
  [[nodiscard]] double angularRate(double t) const
  {
    return kLean * rate * std::cos(rate * t + phase);
  }
  [[nodiscard]] double velocity(double t) const { return kLever * angularRate(t); }
  [[nodiscard]] double acceleration(double t) const { return -kLever * rate * rate * angle(t); }

  static constexpr double kLean = 0.003, kLever = 1.2;  // [rad], [m]
  double rate, phase;                                   // [rad/s], [rad]
};

std::vector<ImuSample> samplesOf(const Standing& sway, const RestTruth& truth, Random& random)
{
  std::vector<ImuSample> samples = samplesAtRest(truth, random);
  for (ImuSample& sample : samples)
  {
    const double t = toSeconds(sample.stamp_ns);
    sample.gyro.y() += sway.angularRate(t);
    // Gravity leans the other way in the frame of the sensor.
    sample.accel.x() += sway.acceleration(t) + truth.g.z() * sway.angle(t);
  }
  return samples;
}

TEST(RestStatistics, FindNoSwayInNoiseNorInAnEngine)
{
  Random random(11);
  constexpr int kDraws = 500;
  int found = 0;
  for (int k = 0; k < kDraws; ++k)
  {
    const RestStatistics rest = restStatistics(samplesWithAnEngine(drawTruth({}, random), random));
    found += rest.sway.rate + rest.sway.force > 0.0 ? 1 : 0;
    EXPECT_EQ(rest.sway.velocity > 0.0, rest.sway.force > 0.0);
  }
  EXPECT_LT(found, kDraws / 12);  // each of six axes in one of 150 cases
}

// Gyro biases, the direction of gravity and the velocity were up to a hundred times surer than they
// were right: the first seconds of a run that somebody begins who stands.
TEST(InitialState, IsNotTooSureOfItselfWhereSomebodySways)
{
  const InitializationOptions p;
  Random random(12);
  double gyro = 0.0, lean = 0.0, velocity = 0.0;
  constexpr int kDraws = 500;
  constexpr double kEnd = 5e-3 * (kSamples - 1);  // [s]
  for (int k = 0; k < kDraws; ++k)
  {
    RestTruth truth = drawTruth(p, random);
    truth.g = {0.0, 0.0, -p.gravity};
    truth.accel_bias.setZero();
    const Standing sway(random);
    const FilterState s = initialState(restStatistics(samplesOf(sway, truth, random)), p);
    const double gyro_error = s.x.gyro_bias.y() - truth.gyro_bias.y();
    gyro += gyro_error * gyro_error / s.P(kGyroBias + 1, kGyroBias + 1) / kDraws;
    velocity += std::pow(sway.velocity(kEnd), 2) / s.P(kVelocity, kVelocity) / kDraws;
    // Bias and gravity together are what the accelerometer has to show at the end.
    const Vec3 force = s.x.accel_bias - s.x.R.transpose() * s.x.g;
    const double error = force.x() - truth.g.z() * sway.angle(kEnd);
    const Eigen::Matrix<double, 2, 2> P{
        {s.P(kAccelBias, kAccelBias), s.P(kAccelBias, kGravity)},
        {s.P(kGravity, kAccelBias), s.P(kGravity, kGravity)}};
    const Eigen::Vector2d difference(1.0, -1.0);
    lean += error * error / difference.dot(P * difference) / kDraws;
  }
  EXPECT_LT(gyro, 2.0);
  EXPECT_LT(lean, 2.0);
  EXPECT_LT(velocity, 2.0);
  EXPECT_GT(std::min({gyro, lean, velocity}), 0.05) << "not worthless either";
}
}  // namespace
}  // namespace fastlio
