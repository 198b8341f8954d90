// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/run/run_statistics.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
/** A scan that leaves one direction open. */
ScanResult openScan(ScanStatus status)
{
  ScanResult result;
  result.status = status;
  result.statistics.constraints.unconstrained = 1;
  return result;
}

/** A start that is searched in vain in a saved map would report a tunnel. */
TEST(RunStatistics, TheSearchForTheStartHasNoDegenerateDirections)
{
  RunStatistics statistics;
  statistics.add(openScan(ScanStatus::Initializing));
  EXPECT_EQ(statistics.degenerateDirections().scans, 0U);
  statistics.add(openScan(ScanStatus::Tracking));
  EXPECT_EQ(statistics.degenerateDirections().scans, 1U);
}
}  // namespace
}  // namespace fastlio
