// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_problems.h"
#include <fastlio/filter/backward_propagation.h>
#include <fastlio/filter/propagation.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;

/** A scan's inertial samples and the forward states at their stamps and at the end. */
struct Scan
{
  std::vector<ImuSample> samples;
  std::int64_t end_ns = 0;
  std::vector<NavState> states;  //!< one per sample, then the one at end_ns
};

/** Seconds from the sample at i to the next one, or to the scan's end. */
double periodOf(const Scan& scan, std::size_t i)
{
  const std::int64_t next =
      i + 1 < scan.samples.size() ? scan.samples[i + 1].stamp_ns : scan.end_ns;
  return toSeconds(next - scan.samples[i].stamp_ns);
}

void propagateForward(Scan& scan, const NavState& start)
{
  scan.states = {start};
  for (std::size_t i = 0; i < scan.samples.size(); ++i)
  {
    const ImuSample& s = scan.samples[i];
    scan.states.push_back(propagateMean(scan.states.back(), s.gyro, s.accel, periodOf(scan, i)));
  }
}

/** Random inputs at uneven stamps. */
Scan randomScan(testing::Random& random, int samples, double rate)
{
  Scan scan;
  std::int64_t stamp = kStart;
  for (int i = 0; i < samples; ++i)
  {
    scan.samples.push_back({stamp, random.vector(rate), random.vector(10.0)});
    stamp += 1'000'000 + static_cast<std::int64_t>(random.uniform(0.0, 9e6));
  }
  scan.end_ns = stamp;
  propagateForward(scan, random.state());
  return scan;
}

std::vector<MotionKnot> knotsOf(const Scan& scan)
{
  std::vector<MotionKnot> knots;
  backwardPropagate(scan.states.back(), scan.end_ns, scan.samples, knots);
  return knots;
}

/** State after t seconds at constant body rate and body acceleration from rest, gravity off:
 * R = Exp(w t), v = A(w t) t a (the integral of R a), p the integral of v by Simpson's rule. */
NavState exactMotion(const Vec3& w, const Vec3& a, double t)
{
  constexpr int kIntervals = 100;
  const auto velocity = [&](double s) { return Vec3(leftJacobianSO3(s * w) * a * s); };
  const double h = t / kIntervals;
  NavState x;
  x.g.setZero();
  x.R = expSO3(t * w);
  x.v = velocity(t);
  for (int i = 0; i < kIntervals; ++i)
  {
    x.p += h / 6.0 * (velocity(i * h) + 4.0 * velocity((i + 0.5) * h) + velocity((i + 1) * h));
  }
  return x;
}

TEST(BackwardPropagation, KnotsMeetTheForwardStates)
{
  testing::Random random(21);
  for (const double rate : {0.0, 0.1, 3.0, 20.0})
  {
    for (int n : {1, 2, 20, 40})
    {
      const Scan scan = randomScan(random, n, rate);
      const std::vector<MotionKnot> knots = knotsOf(scan);
      ASSERT_EQ(knots.size(), scan.states.size());
      const NavState& end = scan.states.back();
      for (std::size_t i = 0; i < knots.size(); ++i)
      {
        const Pose expected = end.pose().inverse() * scan.states[i].pose();
        EXPECT_LT((knots[i].R - expected.R).norm(), 1e-13);
        EXPECT_LT((knots[i].p - expected.p).norm(), 1e-12);
        EXPECT_LT((knots[i].v - end.R.transpose() * scan.states[i].v).norm(), 1e-12);
      }
    }
  }
}

TEST(BackwardPropagation, KnotsCarryStampsAndInputs)
{
  testing::Random random(22);
  const Scan scan = randomScan(random, 20, 1.0);
  const std::vector<MotionKnot> knots = knotsOf(scan);
  const NavState& end = scan.states.back();
  for (std::size_t i = 0; i < scan.samples.size(); ++i)
  {
    EXPECT_EQ(knots[i].stamp_ns, scan.samples[i].stamp_ns);
    EXPECT_LT((knots[i].w - (scan.samples[i].gyro - end.gyro_bias)).norm(), 1e-15);
    const Vec3 half = 0.5 * periodOf(scan, i) * knots[i].w;
    const Vec3 a_world =
        scan.states[i].R * expSO3(half) * (scan.samples[i].accel - end.accel_bias) + end.g;
    EXPECT_LT((knots[i].a - end.R.transpose() * a_world).norm(), 1e-12);
  }
  EXPECT_EQ(knots.back().stamp_ns, scan.end_ns);
  EXPECT_EQ(knots.back().R, Mat3::Identity());
  EXPECT_EQ(knots.back().p, Vec3::Zero());
}

/** Eq. 9 as printed: the value at the right of each step feeds velocity and position. */
std::vector<Pose> equation9AsPrinted(const Scan& scan)
{
  const NavState& end = scan.states.back();
  const Vec3 g_k = end.R.transpose() * end.g;
  Pose T;
  Vec3 v = end.R.transpose() * end.v;
  std::vector<Pose> poses(scan.samples.size() + 1);
  for (std::size_t i = scan.samples.size(); i-- > 0;)
  {
    const double dt = periodOf(scan, i);
    T.p -= v * dt;
    v -= (T.R * (scan.samples[i].accel - end.accel_bias) + g_k) * dt;
    T.R = T.R * expSO3((end.gyro_bias - scan.samples[i].gyro) * dt);
    poses[i] = T;
  }
  return poses;
}

/** Largest distance between the knots and eq. 9 as printed, for n samples over 0.1 s. */
double distanceFromEquation9(int n)
{
  Scan scan;
  for (int i = 0; i < n; ++i)
  {
    scan.samples.push_back({kStart + 100'000'000LL * i / n, Vec3(0.5, -1.0, 2.0), Vec3(3, 1, 9)});
  }
  scan.end_ns = kStart + 100'000'000;
  propagateForward(scan, NavState{});
  const std::vector<MotionKnot> knots = knotsOf(scan);
  const std::vector<Pose> printed = equation9AsPrinted(scan);
  double distance = 0.0;
  for (std::size_t i = 0; i < knots.size(); ++i)
  {
    distance = std::max(distance, (knots[i].p - printed[i].p).norm());
    EXPECT_LT((knots[i].R - printed[i].R).norm(), 1e-13);
  }
  return distance;
}

TEST(BackwardPropagation, AgreesWithEquation9ToFirstOrder)
{
  const double coarse = distanceFromEquation9(20);
  const double fine = distanceFromEquation9(200);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_NEAR(coarse / fine, 10.0, 1.0);
}

/** Largest error against the exact motion with n samples over 0.1 s, between the knots too. */
double errorAgainstExactMotion(int n)
{
  const Vec3 w(1.0, -2.0, 4.0);
  const Vec3 a(2.0, -1.0, 3.0);
  const NavState end = exactMotion(w, a, 0.1);
  std::vector<ImuSample> samples;
  for (int i = 0; i < n; ++i)
    samples.push_back({kStart + 100'000'000LL * i / n, w, a});
  std::vector<MotionKnot> knots;
  backwardPropagate(end, kStart + 100'000'000, samples, knots);
  double error = 0.0;
  for (const double t : {0.0, 0.0213, 0.05, 0.0777, 0.1})
  {
    const Pose expected = end.pose().inverse() * exactMotion(w, a, t).pose();
    const Pose pose = bodyPoseAt(knots, kStart + toNanoseconds(t));
    EXPECT_LT((pose.R - expected.R).norm(), 1e-6);
    error = std::max(error, (pose.p - expected.p).norm());
  }
  return error;
}

TEST(BackwardPropagation, ConvergesToTheExactMotionWithTheSampleRate)
{
  const double at_200_hz = errorAgainstExactMotion(20);
  const double at_2_khz = errorAgainstExactMotion(200);
  EXPECT_LT(at_200_hz, 1e-5);
  EXPECT_NEAR(at_200_hz / at_2_khz, 100.0, 5.0);  // of second order
}

TEST(BodyPoseAt, IsExactForConstantVelocityAndRate)
{
  // Without acceleration the zero-order hold is no approximation: every instant is exact.
  testing::Random random(23);
  NavState end = random.state();
  const Vec3 w = random.vector(2.0);
  std::vector<ImuSample> samples;
  const std::array<double, 3> middles{0.015, 0.045, 0.08};  // of the times that they hold for
  for (int i = 0; i < 3; ++i)
  {
    // Specific force that cancels gravity.
    const double before_end = 0.1 - middles[static_cast<std::size_t>(i)];
    const Mat3 R = end.R * expSO3(-before_end * w);
    samples.push_back(
        {kStart + 30'000'000LL * i, end.gyro_bias + w, end.accel_bias - R.transpose() * end.g});
  }
  std::vector<MotionKnot> knots;
  backwardPropagate(end, kStart + 100'000'000, samples, knots);
  // From before the first sample to after the scan's end.
  for (const int ms : {-20, -1, 0, 13, 30, 59, 60, 99, 100, 120})
  {
    const double dt = 1e-3 * ms - 0.1;
    const Pose pose = bodyPoseAt(knots, kStart + 1'000'000LL * ms);
    EXPECT_LT((pose.R - expSO3(dt * w)).norm(), 1e-13) << ms;
    EXPECT_LT((pose.p - end.R.transpose() * end.v * dt).norm(), 1e-13) << ms;
  }
}

TEST(BodyPoseAt, IsContinuousAtTheKnots)
{
  testing::Random random(24);
  const Scan scan = randomScan(random, 20, 5.0);
  const std::vector<MotionKnot> knots = knotsOf(scan);
  for (std::size_t i = 1; i < knots.size(); ++i)
  {
    const Pose at = bodyPoseAt(knots, knots[i].stamp_ns);
    const Pose before = bodyPoseAt(knots, knots[i].stamp_ns - 1);
    EXPECT_EQ(at.R, knots[i].R);
    EXPECT_EQ(at.p, knots[i].p);
    EXPECT_LT((at.R - before.R).norm(), 1e-7);
    EXPECT_LT((at.p - before.p).norm(), 1e-7);
  }
}

TEST(BackwardPropagation, WithoutSamplesTheVelocityCarriesOn)
{
  testing::Random random(25);
  const NavState end = random.state();
  std::vector<MotionKnot> knots(7);
  backwardPropagate(end, kStart, {}, knots);
  ASSERT_EQ(knots.size(), 1u);
  const Pose pose = bodyPoseAt(knots, kStart - 50'000'000);
  EXPECT_EQ(pose.R, Mat3::Identity());
  EXPECT_LT((pose.p + 0.05 * end.R.transpose() * end.v).norm(), 1e-14);
}

TEST(BackwardPropagation, SamplesAtOrAfterTheEndTakeNoPart)
{
  testing::Random random(26);
  const Scan scan = randomScan(random, 10, 1.0);
  const std::vector<MotionKnot> expected = knotsOf(scan);
  Scan longer = scan;
  longer.samples.push_back({scan.end_ns, random.vector(), random.vector()});
  longer.samples.push_back({scan.end_ns + 5'000'000, random.vector(), random.vector()});
  const std::vector<MotionKnot> knots = knotsOf(longer);
  ASSERT_EQ(knots.size(), expected.size());
  for (std::size_t i = 0; i < knots.size(); ++i)
    EXPECT_EQ(knots[i].p, expected[i].p);
}

TEST(BackwardPropagation, BadInputIsRefusedByName)
{
  std::vector<MotionKnot> knots;
  std::vector<ImuSample> jump(2);
  jump[0].stamp_ns = kStart + 10;
  jump[1].stamp_ns = kStart;
  try
  {
    backwardPropagate(NavState{}, kStart + 20, jump, knots);
    FAIL() << "a stamp that jumps back was accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string(error.what()).find("sample 1 "), std::string::npos) << error.what();
  }
  knots.clear();
  EXPECT_THROW((void)bodyPoseAt(knots, kStart), std::invalid_argument);
}
}  // namespace
}  // namespace fastlio
