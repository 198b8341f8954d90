// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_test_support.h"

namespace fastlio
{
namespace
{
using testing::reportOf;
using testing::walk;

TEST(ReportTables, AGapOfTheInertialDataIsThereWithItsLength)
{
  RunSummary run;
  EXPECT_NE(reportOf(walk(50), run).find("gaps: 0, samples missing: 0"), std::string::npos);
  run.imu.gaps = 1;
  run.imu.longest_gap = 1.0034;
  EXPECT_NE(
      reportOf(walk(50), run).find("gaps: 1 (longest 1.003 s), samples missing: 0"),
      std::string::npos);
}
}  // namespace
}  // namespace fastlio
