// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "classified_scans.h"
#include <fastlio/health/run_diagnostics.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

/** The offset of two free clocks. It is known from the begin on, but wrong at first. */
TEST(RunDiagnostics, TellClocksThatDrift)
{
  const auto textsWith = [](double drift)
  {
    RunDiagnostics diagnostics{OdometryOptions{}};
    for (int i = 0; i < 800; ++i)
    {
      const double seconds = 0.1 * i;
      const double offset = 0.002 + drift * seconds + (seconds < 10.0 ? 0.004 : 0.0);
      ScanResult scan = scanWithClocksApart(offset, 0.0003);
      scan.stamp_ns = toNanoseconds(100.0 + seconds);
      diagnostics.consider(scan);
    }
    return diagnostics.all();
  };
  EXPECT_TRUE(textsWith(0.0).empty());
  const std::vector<Diagnostic> found = textsWith(1e-4);
  ASSERT_EQ(found.size(), 1U) << "once is enough";
  EXPECT_NE(found[0].text.find("changed by 3.0 ms within 30 s"), std::string::npos)
      << found[0].text;
}

/** Deg/s that count as rad/s scatter fifty times as much. */
TEST(RunDiagnostics, TheScatterOfAWrongUnitIsForgotten)
{
  RunDiagnostics diagnostics{OdometryOptions{}};
  const auto rest = [&](double rate, double from_s, double until_s)
  {
    for (int i = 0; i * 0.005 < until_s - from_s; ++i)
    {
      const auto stamp_ns = static_cast<std::int64_t>(1e9 * (100.0 + from_s + 0.005 * i));
      diagnostics.consider(
          ImuSample{stamp_ns, Vec3(i % 2 == 0 ? rate : -rate, 0.0, 0.0), Vec3(0.0, 0.0, 9.81)});
    }
  };
  rest(0.5, 0.0, 4.0);
  diagnostics.forgetScatter();
  rest(0.001, 4.0, 12.0);
  EXPECT_TRUE(diagnostics.all().empty());
  rest(0.5, 12.0, 40.0);
  EXPECT_EQ(diagnostics.all().size(), 1U);
}
