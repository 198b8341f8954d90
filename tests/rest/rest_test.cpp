// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rest_test.cpp Standing still: for long, among things that move, and moving on. */

#include "repeats.h"
#include "simulated_run.h"
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace fastlio::testing
{
namespace
{
// Motion in the truth, above these limits.
constexpr double kMovingSpeed = 0.05;  // [m/s]
constexpr double kTurningRate = 0.05;  // [rad/s]

SimulatedRun runWithRest(const SimulationSettings& settings, bool enabled = true)
{
  OdometryOptions parameters = matchingParameters(settings);
  parameters.threads = 1;
  parameters.rest.enabled = parameters.rest.at_start = enabled;
  return runOdometry(Simulation(settings), parameters);
}

bool moves(const JudgedScan& scan)
{
  return scan.truth.velocity.norm() > kMovingSpeed || scan.truth.angular_rate.norm() > kTurningRate;
}

/** The first scan that ends \a t seconds or more after the start. */
const JudgedScan& scanAt(const SimulatedRun& run, double t)
{
  const std::int64_t stamp_ns = run.scans.front().result.stamp_ns + toNanoseconds(t);
  const auto scan = std::find_if(
      run.scans.begin(), run.scans.end(),
      [&](const JudgedScan& s) { return s.result.stamp_ns >= stamp_ns; });
  return scan == run.scans.end() ? run.scans.back() : *scan;
}

double largestDistance(const SimulatedRun& run, double from)
{
  const JudgedScan& first = scanAt(run, from);
  double largest = 0.0;
  for (const JudgedScan& scan : run.scans)
    if (scan.result.stamp_ns >= first.result.stamp_ns)
      largest = std::max(largest, (scan.result.filter.x.p - first.result.filter.x.p).norm());
  return largest;
}

/** A few hundred points, five times a second. */
SimulationSettings sparse(const std::string& scenario, double duration)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.duration = duration;
  settings.lidar.rate = 5.0;
  settings.lidar.stride = 80;
  settings.imu.rate = 100.0;
  return settings;
}
}  // namespace

TEST(Rest, ALongOneNeitherDriftsNorGrowsTheMap)
{
  const SimulatedRun run = runWithRest(sparse("rest", sampled(1800.0)));
  EXPECT_LT(largestDistance(run, 20.0), 0.01);
  EXPECT_EQ(
      scanAt(run, 20.0).result.statistics.map_points,
      run.scans.back().result.statistics.map_points);
  EXPECT_LT(run.scans.back().result.filter.x.v.norm(), 0.01);
  const Vec3 bias_error =
      run.scans.back().true_bias.gyro - run.scans.back().result.filter.x.gyro_bias;
  EXPECT_LT(bias_error.norm(), 2e-4);
  const std::int64_t settled_ns = scanAt(run, 20.0).result.stamp_ns;
  for (const JudgedScan& scan : run.scans)
    ASSERT_TRUE(scan.result.stamp_ns < settled_ns || scan.result.statistics.at_rest);
}

TEST(Rest, WithoutItTheMapGoesOnGrowing)
{
  const SimulatedRun run = runWithRest(sparse("rest_crowd", 120.0), false);
  EXPECT_LT(
      scanAt(run, 20.0).result.statistics.map_points,
      run.scans.back().result.statistics.map_points);
}

TEST(Rest, ThingsThatMoveDoNotMoveThePlatform)
{
  SimulationSettings settings = defaultSettings("rest_crowd");
  settings.duration = 60.0;
  settings.lidar.stride = 8;
  const SimulatedRun run = runWithRest(settings);
  EXPECT_LT(largestDistance(run, 6.0), 0.005);
  EXPECT_TRUE(run.scans.back().result.statistics.at_rest);
  EXPECT_EQ(
      scanAt(run, 10.0).result.statistics.map_points,
      run.scans.back().result.statistics.map_points);
}

// On a meadow with a few posts, whose scans show little more than the ground.
TEST(Rest, AStartAtRestStaysWhereItIs)
{
  SimulationSettings settings = defaultSettings("open_area");
  settings.duration = 2.5;
  for (settings.seed = 1; settings.seed <= 3; ++settings.seed)
  {
    OdometryOptions parameters = matchingParameters(settings);
    parameters.threads = 1;
    const SimulatedRun with = runOdometry(Simulation(settings), parameters);
    parameters.rest.at_start = false;
    const SimulatedRun without = runOdometry(Simulation(settings), parameters);
    EXPECT_LT(largestDistance(with, 0.0), 0.003);
    EXPECT_LT(largestDistance(with, 0.0), 0.6 * largestDistance(without, 0.0));
    EXPECT_TRUE(with.scans.back().result.statistics.at_rest);
    EXPECT_FALSE(without.scans.back().result.statistics.at_rest);
  }
}

class RestInMotion : public ::testing::TestWithParam<const char*>
{
};

// Rest at the start, then motion: rest is found, left within a scan, and never seen in motion.
TEST_P(RestInMotion, EndsWithinAScan)
{
  SimulationSettings settings = defaultSettings(GetParam());
  settings.rest = 8.0;
  settings.duration = 20.0;
  settings.lidar.stride = 8;
  const SimulatedRun run = runWithRest(settings);
  EXPECT_TRUE(scanAt(run, 7.0).result.statistics.at_rest);
  const auto first_in_motion = std::find_if(run.scans.begin(), run.scans.end(), moves);
  ASSERT_NE(first_in_motion, run.scans.end());
  for (auto scan = first_in_motion; scan != run.scans.end(); ++scan)
    EXPECT_FALSE(moves(*scan) && scan->result.statistics.at_rest) << scan->result.stamp_ns;
  EXPECT_EQ(run.scans.back().result.status, ScanStatus::Tracking);
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, RestInMotion,
    ::testing::Values(
        "campus", "office", "uav", "car", "shake", "spin", "stairs", "open_area", "crowd",
        "tunnel"),
    [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace fastlio::testing
