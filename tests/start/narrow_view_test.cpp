// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file narrow_view_test.cpp A narrow view lets poses at rest drift. That is no motion. */

#include "simulated_run.h"
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <string>

namespace fastlio::testing
{
namespace
{
struct NarrowView
{
  const char* scenario;
  std::uint64_t seed;
};

class RestInANarrowView : public ::testing::TestWithParam<NarrowView>
{
};

// The scans seemed to move by 0.06 to 0.4 m in a second, and could not tell the velocity: the run
// began after five seconds, on the way.
TEST_P(RestInANarrowView, StartsWithTheFirstScan)
{
  SimulationSettings settings = defaultSettings(GetParam().scenario);
  settings.lidar.kind = LidarKind::Livox;
  settings.lidar.stride = 2;
  settings.duration = 4.0;
  settings.seed = GetParam().seed;
  settings = realistic(settings);
  OdometryOptions parameters = matchingParameters(settings);
  parameters.threads = 1;
  const SimulatedRun run = runOdometry(Simulation(settings), parameters);
  ASSERT_EQ(run.scans.front().result.status, ScanStatus::FirstScan)
      << run.scans.front().result.message;
  EXPECT_LT(run.scans.front().result.filter.x.v.norm(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, RestInANarrowView, ::testing::Values(NarrowView{"stairs", 12}, NarrowView{"uav", 17}),
    [](const auto& parameter) { return std::string(parameter.param.scenario); });
}  // namespace
}  // namespace fastlio::testing
