// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Sensors that are as imperfect as their datasheets say are not called broken.

#include "walks.h"
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace fastlio::testing
{
namespace
{
// The biases were released for a step that was none, and the run went 3.3 m astray.
TEST(HealthySensors, ContradictEachOtherAmongTreesWithoutAStep)
{
  SimulationSettings settings = defaultSettings("park");
  settings.duration = 26.0;
  settings.seed = 1;
  settings = realistic(settings);
  OdometryOptions options = matchingParameters(settings);
  options.threads = 1;
  const SimulatedRun run = runOdometry(Simulation(settings), options);
  std::size_t steps = 0, disagreements = 0;
  for (const JudgedScan& scan : run.scans)
  {
    steps += scan.result.statistics.inertial_step ? 1 : 0;
    const ScanHealth& health = scan.result.health;
    disagreements += health.cause == HealthCause::MotionDisagreement && health.value < 0.5 ? 1 : 0;
  }
  EXPECT_EQ(steps, 0U);
  EXPECT_EQ(disagreements, 0U);
  EXPECT_LT(positionError(run, run.scans.back()), 0.3);
}

// On a landing, a LiDAR that looks ahead turns from a wall to stairs that are not in the map yet.
// Few points matched, so their scans did not join the map, and then none matched for the rest of
// the way.
TEST(HealthySensors, ANarrowViewThatTurnsToWhatIsNotMappedIsNotLost)
{
  SimulationSettings settings = defaultSettings("stairs");
  settings.lidar.kind = LidarKind::Livox;
  settings.lidar.stride = 2;
  settings.speed = 2.0;
  settings.duration = 25.0;
  settings.seed = 3;
  OdometryOptions options = matchingParameters(settings);
  options.threads = 1;
  const SimulatedRun run = runOdometry(Simulation(settings), options);
  for (const JudgedScan& scan : run.scans)
  {
    ASSERT_NE(scan.result.status, ScanStatus::Diverged) << scan.result.message;
    EXPECT_LT(positionError(run, scan), 0.1);
  }
}

}  // namespace
}  // namespace fastlio::testing
