// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/scenarios/realistic.h>
#include <fastlio/worlds/path_builder.h>
#include <fastlio/worlds/sampled_motion.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
std::vector<std::string_view> scenarioNames()
{
  std::vector<std::string_view> names;
  for (const auto& info : scenarioTable())
    names.push_back(info.name);
  return names;
}

/** Largest angular rate [rad/s] of a simulation. */
double fastestTurn(const Simulation& simulation)
{
  double fastest = 0.0;
  for (double t = 0.0; t < simulation.settings().duration; t += 0.005)
    fastest = std::max(fastest, simulation.motion().at(t).angular_rate.norm());
  return fastest;
}

/** How far two poses are apart [m], and how far their axes. */
double difference(const Pose& a, const Pose& b)
{
  return std::max((a.p - b.p).norm(), (a.R - b.R).norm());
}

TEST(SampledMotion, IsTheMotion)
{
  for (const std::string_view name : scenarioNames())
  {
    const Simulation simulation(realistic(testing::shortSettings(name, 6.0)));
    const Motion& motion = simulation.motion();
    SampledMotion sampled(motion);
    double worst = 0.0;
    for (double t = -0.01; t < 6.0; t += t < 5.9 ? 0.01371 : 2.3e-6)
      worst = std::max(worst, difference(sampled.at(t), motion.pose(t)));
    EXPECT_LT(worst, 1e-11) << name;
  }
}

TEST(SampledMotion, DoesNotDependOnWhatWasAskedBefore)
{
  const Simulation simulation(realistic(testing::shortSettings("office", 6.0)));
  SampledMotion forward(simulation.motion()), backward(simulation.motion());
  std::vector<Pose> poses;
  for (int i = 0; i < 500; ++i)
    poses.push_back(forward.at(4.0 + 7e-5 * i));
  for (int i = 499; i >= 0; --i)
    EXPECT_EQ(difference(backward.at(4.0 + 7e-5 * i), poses[static_cast<std::size_t>(i)]), 0.0);
}

TEST(UniformSpline, DerivativesMatchDifferences)
{
  const UniformSpline spline({0.0, 1.0, -2.0, 0.5, 3.0, 1.0, 0.2}, 0.7, 1.5);
  constexpr double kStep = 1e-5;
  for (double u = -6.0; u < 12.0; u += 0.173)
  {
    const Jet jet = spline.at(u);
    const double before = spline.value(u - kStep), after = spline.value(u + kStep);
    EXPECT_DOUBLE_EQ(jet.value, spline.value(u));
    EXPECT_NEAR(jet.first, (after - before) / (2 * kStep), 1e-8);
    EXPECT_NEAR(jet.second, (after - 2 * jet.value + before) / (kStep * kStep), 1e-4);
  }
}

TEST(UniformSpline, WindsByTheGivenAmountPerPeriod)
{
  const UniformSpline spline({0.0, 1.0, -2.0, 0.5, 3.0, 1.0, 0.2}, 0.7, 1.5);
  for (double u = -3.0; u < 3.0; u += 0.31)
    EXPECT_NEAR(spline.value(u + spline.period()), spline.value(u) + 1.5, 1e-12);
}

TEST(UniformSpline, FourDerivativesAreContinuousAtKnots)
{
  const UniformSpline spline({0.0, 1.0, -2.0, 0.5, 3.0, 1.0, 0.2, -1.0}, 1.0);
  // The second derivative is once more twice differentiable: its second difference has no jump.
  constexpr double kStep = 1e-3;
  const auto fourth = [&](double u)
  {
    return (spline.at(u + kStep).second - 2 * spline.at(u).second + spline.at(u - kStep).second) /
           (kStep * kStep);
  };
  for (double knot = 0.0; knot < 8.0; knot += 1.0)
    EXPECT_NEAR(fourth(knot - 2 * kStep), fourth(knot + 2 * kStep), 0.5);
}

TEST(UniformSpline, RejectsWhatIsNoSpline)
{
  EXPECT_THROW(UniformSpline({1.0}, 0.0), std::invalid_argument);
  EXPECT_THROW(UniformSpline({std::nan("")}, 1.0), std::invalid_argument);
}

TEST(MotionTiming, StartsAndStopsSmoothly)
{
  MotionTiming timing;
  timing.stop_at = 10.0;
  timing.rate = 1.5;
  constexpr double kStep = 1e-4;
  for (double t = 0.0; t < timing.stopTime() + 1.0; t += 0.0137)
  {
    const Jet u = timing.at(t);
    const double before = timing.at(t - kStep).value, after = timing.at(t + kStep).value;
    EXPECT_NEAR(u.first, (after - before) / (2 * kStep), 1e-6);
    EXPECT_NEAR(
        u.second, (timing.at(t + kStep).first - timing.at(t - kStep).first) / (2 * kStep), 1e-5);
  }
  EXPECT_EQ(timing.at(timing.rest).value, 0.0);
  EXPECT_NEAR(timing.at(timing.stopTime()).value, 10.0, 1e-12);
  EXPECT_NEAR(timing.at(timing.stopTime() + 5.0).value, 10.0, 1e-12);
}

TEST(MotionTiming, StartsFurtherOnThePath)
{
  MotionTiming early, late;
  early.rate = late.rate = 1.5;
  early.stop_at = 10.0;
  late.start = 4.0;
  late.stop_at = 14.0;
  for (double t = 0.0; t < early.stopTime() + 1.0; t += 0.137)
  {
    EXPECT_NEAR(late.at(t).value, early.at(t).value + 4.0, 1e-12);
    EXPECT_EQ(late.at(t).first, early.at(t).first);
  }
  EXPECT_EQ(late.stopTime(), early.stopTime());
}

TEST(Motion, RejectsImpossibleTiming)
{
  MotionTiming timing;
  timing.rate = 0.0;
  EXPECT_THROW(Motion({}, timing), std::invalid_argument);
  timing.rate = 1.0;
  timing.rest = -1.0;
  EXPECT_THROW(Motion({}, timing), std::invalid_argument);
}

TEST(Motion, RoutesNeedTwoCornersAndSpeed)
{
  Route route;
  route.corners = {{0, 0, 0}};
  EXPECT_THROW((void)followRoute(route), std::invalid_argument);
  route.corners = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}};
  EXPECT_GT(loopLength(followRoute(route)), 20.0);
  route.speed = 0.0;
  EXPECT_THROW((void)followRoute(route), std::invalid_argument);
}

class EveryScenario : public ::testing::TestWithParam<std::string_view>
{
};

TEST_P(EveryScenario, KinematicsAreTheDerivativesOfThePose)
{
  const Simulation simulation(testing::shortSettings(GetParam(), 25.0));
  const Motion& motion = simulation.motion();
  constexpr double kStep = 1e-5;
  for (double t = 0.5; t < 25.0; t += 0.137)
  {
    const Kinematics k = motion.at(t);
    const Kinematics before = motion.at(t - kStep), after = motion.at(t + kStep);
    const Pose pose = motion.pose(t);
    EXPECT_LT((pose.p - k.T_world_imu.p).norm(), 1e-12);
    EXPECT_LT((pose.R - k.T_world_imu.R).norm(), 1e-12);
    const Vec3 v = (after.T_world_imu.p - before.T_world_imu.p) / (2 * kStep);
    const Vec3 a = (after.velocity - before.velocity) / (2 * kStep);
    const Vec3 w = logSO3(before.T_world_imu.R.transpose() * after.T_world_imu.R) / (2 * kStep);
    EXPECT_LT((k.velocity - v).norm(), 1e-6) << "t = " << t;
    EXPECT_LT((k.acceleration - a).norm(), 1e-5) << "t = " << t;
    EXPECT_LT((k.angular_rate - w).norm(), 1e-6) << "t = " << t;
  }
}

TEST_P(EveryScenario, RestsAtTheStart)
{
  const Simulation simulation(testing::shortSettings(GetParam(), 5.0));
  ASSERT_GE(simulation.settings().rest, 2.5);
  const Pose start = simulation.motion().pose(0.0);
  for (double t = 0.0; t <= simulation.settings().rest; t += 0.1)
  {
    const Kinematics k = simulation.motion().at(t);
    EXPECT_EQ(k.velocity.norm() + k.acceleration.norm() + k.angular_rate.norm(), 0.0);
    EXPECT_EQ((k.T_world_imu.p - start.p).norm(), 0.0);
  }
}

TEST_P(EveryScenario, NeverRunsThroughAWall)
{
  SimulationSettings settings = defaultSettings(GetParam());
  const Simulation simulation(settings);
  const Motion& motion = simulation.motion();
  constexpr double kStep = 0.02, kClearance = 0.2;
  for (double t = settings.rest; t < simulation.settings().duration; t += kStep)
  {
    const Vec3 here = motion.pose(t).p, there = motion.pose(t + kStep).p;
    const double step = (there - here).norm();
    if (step < 1e-6) continue;
    const Ray ahead{here, (there - here) / step};
    EXPECT_FALSE(simulation.world().cast(ahead, t, step + kClearance))
        << "at " << here.transpose() << ", t = " << t;
  }
}

TEST_P(EveryScenario, NoiseFreeImuIntegratesToTheTruth)
{
  SimulationSettings settings = testing::withoutErrors(testing::shortSettings(GetParam(), 12.0));
  settings.imu.rate = 8000.0;
  const Simulation simulation(settings);
  const auto& samples = simulation.imu().samples;
  const Kinematics start = simulation.truth(settings.start_ns);
  const Vec3 gravity(0.0, 0.0, -settings.gravity);
  Mat3 R = start.T_world_imu.R;
  Vec3 p = start.T_world_imu.p, v = start.velocity;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i)
  {
    const double dt = toSeconds(samples[i + 1].stamp_ns - samples[i].stamp_ns);
    const Mat3 next = R * expSO3(0.5 * dt * (samples[i].gyro + samples[i + 1].gyro));
    const Vec3 a0 = R * samples[i].accel + gravity, a1 = next * samples[i + 1].accel + gravity;
    p += dt * v + dt * dt * (a0 / 3.0 + a1 / 6.0);
    v += 0.5 * dt * (a0 + a1);
    R = next;
  }
  const Kinematics end = simulation.truth(samples.back().stamp_ns);
  EXPECT_LT((p - end.T_world_imu.p).norm(), 1e-3);
  EXPECT_LT((v - end.velocity).norm(), 2e-4);
  EXPECT_LT(logSO3(R.transpose() * end.T_world_imu.R).norm(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Catalog, EveryScenario, ::testing::ValuesIn(scenarioNames()),
    [](const auto& test) { return std::string(test.param); });

TEST(Scenario, CampusIsALoopOf140Metres)
{
  const Simulation simulation(defaultSettings("campus"));
  const CarrierPath& path = simulation.motion().path();
  EXPECT_NEAR(loopLength(path), 140.0, 1.5);
  const double end = simulation.settings().duration;
  const Pose first = simulation.motion().pose(0.0), last = simulation.motion().pose(end);
  EXPECT_LT((first.p - last.p).norm(), 1e-6);
  EXPECT_LT(logSO3(first.R.transpose() * last.R).norm(), 1e-6);
  EXPECT_EQ(simulation.motion().at(end).velocity.norm(), 0.0);
}

TEST(Scenario, ShakeAndSpinTurnAsFastAsPromised)
{
  EXPECT_GT(fastestTurn(Simulation(testing::shortSettings("shake", 15.0))) * kDegPerRad, 500.0);
  EXPECT_GT(fastestTurn(Simulation(testing::shortSettings("spin", 15.0))) * kDegPerRad, 1000.0);
}

TEST(Scenario, SpeedScalesTheMotion)
{
  SimulationSettings fast = testing::shortSettings("office", 8.0);
  fast.speed = 2.0;
  const Simulation once(testing::shortSettings("office", 8.0)), twice(fast);
  EXPECT_NEAR(
      twice.motion().at(7.0).velocity.norm(),
      2.0 * once.motion().at(2.5 + 2.0 * 4.5 - 1.0).velocity.norm(), 1e-9);
}

TEST(Scenario, UnknownNamesGetTheNearestOne)
{
  try
  {
    (void)defaultSettings("offce");
    FAIL() << "an unknown scenario was accepted";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_NE(std::string(e.what()).find("'office'"), std::string::npos) << e.what();
  }
}
}  // namespace
}  // namespace fastlio
