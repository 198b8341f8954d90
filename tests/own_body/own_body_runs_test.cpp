// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file own_body_runs_test.cpp Runs of a LiDAR that sees the person who carries it, and of some that
 * only seem to. */

#include "simulated_run.h"

#include <gtest/gtest.h>

namespace fastlio::testing
{
namespace
{
struct Masked
{
  std::size_t points = 0;   // of all scans
  double at_the_end = 0.0;  // of the points of the last scans, the fraction
};

Masked maskedIn(const char* scenario, double duration, bool body)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.lidar.stride = 4;
  settings.lidar.min_range = 0.3;
  settings.duration = duration;
  settings.carrier.body = body;
  OdometryOptions parameters = matchingParameters(settings);
  parameters.threads = 1;
  const SimulatedRun run = runOdometry(Simulation(settings), parameters);
  Masked masked;
  std::size_t last = 0, last_in = 0;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
  {
    const ScanStatistics& scan = run.scans[i].result.statistics;
    masked.points += scan.dropped_own_body;
    if (i + 10 < run.scans.size()) continue;
    last += scan.dropped_own_body;
    last_in += scan.points_in;
  }
  masked.at_the_end = static_cast<double>(last) / static_cast<double>(last_in);
  return masked;
}

TEST(OwnBodyRuns, ThePersonWhoCarriesTheLidarIsMasked)
{
  EXPECT_GT(maskedIn("office", 32.0, true).at_the_end, 0.02);
}

TEST(OwnBodyRuns, WallsAreNot)
{
  EXPECT_EQ(maskedIn("office", 20.0, false).points, 0U);
  EXPECT_EQ(maskedIn("tunnel", 20.0, false).points, 0U) << "walls that stay where they are";
}

TEST(OwnBodyRuns, NothingIsWhileTheLidarStands)
{
  EXPECT_EQ(maskedIn("rest", 6.0, true).points, 0U);
}
}  // namespace
}  // namespace fastlio::testing
