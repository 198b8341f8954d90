// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "classified_scans.h"
#include <fastlio/health/run_diagnostics.h>

#include <gtest/gtest.h>

#include <string>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
ScanResult scanWithClocksApart(double offset, double std)
{
  ScanResult r = goodScan();
  r.filter.x.time_offset = offset;
  r.filter.P(kTimeOffset, kTimeOffset) = std * std;
  return r;
}
}  // namespace

/** Points that were stamped with the end of the scan and not with its begin: 98 ms, and all that
 * the run said was that it can be trusted. */
TEST(RunDiagnostics, TellClocksThatAreFarApart)
{
  OdometryOptions options;
  options.lidar.time_offset = 0.01;
  RunDiagnostics diagnostics(options);
  diagnostics.consider(scanWithClocksApart(0.098, 0.0002));
  diagnostics.consider(scanWithClocksApart(0.098, 0.0001));
  ASSERT_EQ(diagnostics.all().size(), 1U) << "once is enough";
  const std::string& text = diagnostics.all().front().text;
  EXPECT_NE(text.find("98.0 +- 0.2 ms"), std::string::npos) << text;
  EXPECT_NE(text.find("lidar.time_offset to 0.1080"), std::string::npos) << text;
}

TEST(RunDiagnostics, KeepQuietAboutClocksThatAreAsGivenOrNotKnownYet)
{
  RunDiagnostics diagnostics{OdometryOptions{}};
  diagnostics.consider(scanWithClocksApart(0.004, 0.0001));  // of 3 ms standard deviation
  diagnostics.consider(scanWithClocksApart(0.098, 0.003));   // the motion has not shown it
  diagnostics.consider(scanWithClocksApart(0.098, 0.0));     // it is not estimated
  EXPECT_TRUE(diagnostics.all().empty());
}
