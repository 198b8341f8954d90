// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/motion_fit.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriodNs = 5'000'000;
const Vec3 kVelocity0{6.0, -1.5, 0.4};
const Vec3 kGravityVector = Vec3(0.4, -0.3, -1.0).normalized() * 9.81;

/** A turning platform whose acceleration changes, followed exactly at a fine step. */
struct Drive
{
  std::vector<ImuSample> inputs;
  std::vector<StampedPose> poses;
  MotionFitPrior prior;
};

Vec3 rateAt(double t)
{
  return {0.3 * std::sin(5.0 * t), 0.2, 0.8 * std::cos(3.0 * t)};
}

Vec3 accelerationAt(double t)
{
  return {1.5 * std::sin(4.0 * t), 2.0 * std::cos(2.0 * t), 0.5};
}

Drive drive(double seconds, int poses_every)
{
  Drive d;
  d.prior.g = {0.0, 0.0, -9.81};  // magnitude right, direction 30 degrees off
  const int samples = static_cast<int>(std::lround(seconds * 1e9 / double(kPeriodNs)));
  constexpr int kFine = 50;
  const double dt = toSeconds(kPeriodNs) / kFine;
  Mat3 R = expSO3({0.1, 0.2, -0.4});
  Vec3 p{1.0, 2.0, 3.0}, v = kVelocity0;
  for (int i = 0; i <= samples; ++i)
  {
    const std::int64_t stamp_ns = kStart + i * kPeriodNs;
    if (i % poses_every == 0) d.poses.push_back({stamp_ns, {R, p}});
    const double middle = (double(i) + 0.5) * kFine * dt;
    ImuSample input{stamp_ns, rateAt(middle), Vec3::Zero()};
    for (int k = 0; k < kFine; ++k)
    {
      const Vec3 a = accelerationAt((double(i) * kFine + k + 0.5) * dt);
      if (k == kFine / 2) input.accel = R.transpose() * (a - kGravityVector);
      p += dt * v + 0.5 * dt * dt * a;
      v += dt * a;
      R = R * expSO3(dt * input.gyro);
    }
    d.inputs.push_back(input);
  }
  return d;
}
}  // namespace

TEST(MotionFit, FindsVelocityAndGravity)
{
  const Drive d = drive(1.0, 20);
  const MotionFit fit = fitMotion(d.poses, d.inputs, d.prior);
  ASSERT_TRUE(fit.solved);
  EXPECT_LT((fit.velocity - kVelocity0).norm(), 0.005);
  EXPECT_LT((fit.g - kGravityVector).norm(), 0.02);
}

TEST(MotionFit, AnErrorThatAllPosesButTheFirstShareDoesNotMatter)
{
  Drive d = drive(1.0, 20);
  const MotionFit exact = fitMotion(d.poses, d.inputs, d.prior);
  for (std::size_t k = 1; k < d.poses.size(); ++k)
    d.poses[k].T_world_body.p += Vec3(0.05, -0.03, 0.02);
  const MotionFit shifted = fitMotion(d.poses, d.inputs, d.prior);
  EXPECT_LT((shifted.velocity - exact.velocity).norm(), 1e-3);
  EXPECT_LT((shifted.g - exact.g).norm(), 1e-2);
}

TEST(MotionFit, KnowsTheMagnitudeOfGravity)
{
  Drive d = drive(1.0, 20);
  for (std::size_t k = 0; k < d.poses.size(); ++k)
    d.poses[k].T_world_body.p += (k % 2 == 0 ? 0.01 : -0.01) * Vec3::Ones();
  EXPECT_NEAR(fitMotion(d.poses, d.inputs, d.prior).g.norm(), 9.81, 0.02);
}

TEST(MotionFit, FewPosesAreNotSolved)
{
  Drive d = drive(1.0, 20);
  d.poses.resize(3);
  EXPECT_FALSE(fitMotion(d.poses, d.inputs, d.prior).solved);
  EXPECT_FALSE(fitMotion({}, {}, d.prior).solved);
}

TEST(MotionFit, NumbersThatAreNotFiniteAreNotSolved)
{
  Drive d = drive(1.0, 20);
  d.poses[2].T_world_body.p.x() = std::nan("");
  EXPECT_FALSE(fitMotion(d.poses, d.inputs, d.prior).solved);
}

}  // namespace fastlio
