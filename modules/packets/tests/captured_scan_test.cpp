// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Where scans begin and end, whichever LiDAR sends the packets.

#include "recording_test_support.h"
#include <fastlio/packets/captured_scan.h>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

constexpr std::int64_t kTenthNs = 100'000'000;

/** The scans of blocks that begin at these times, with one point each. */
ObservationQueue scansOf(const std::vector<std::int64_t>& stamps_ns, double after_ns = 0.0)
{
  CapturedScan scan("lidar", kTenthNs);
  ObservationQueue scans;
  for (const std::int64_t stamp_ns : stamps_ns)
  {
    scan.beginBlock(stamp_ns, false, scans);
    scan.add({1.0, 2.0, 3.0, 4.0F, 5}, after_ns);
  }
  scan.flush(scans);
  return scans;
}

TEST(CapturedScan, EndsWhenItHasLastedItsTime)
{
  EXPECT_EQ(scansOf({kStart, kStart + kTenthNs - 1}).size(), 1U);
  EXPECT_EQ(scansOf({kStart, kStart + kTenthNs}).size(), 2U);
}

TEST(CapturedScan, BeginsWithItsFirstPointAlsoWherePacketsOvertakeEachOther)
{
  const ObservationQueue scans = scansOf({kStart + 480'000, kStart, kStart + 960'000}, 55.0);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(toNanoseconds(scans.front()->timestamp), kStart);
  const std::vector<double> times = columnsOf(*scans.front()).time;
  ASSERT_EQ(times.size(), 3U);
  EXPECT_NEAR(times[0], 480'055e-9, 1e-12);
  EXPECT_NEAR(times[1], 55e-9, 1e-12);
  EXPECT_NEAR(times[2], 960'055e-9, 1e-12);
  EXPECT_EQ(scansOf({kStart, kStart - 2'000'000}).size(), 2U) << "the clock was set back";
}

TEST(CapturedScan, OfACoveredLidarHasNoPoints)
{
  CapturedScan scan("lidar");
  ObservationQueue scans;
  scan.flush(scans);
  EXPECT_TRUE(scans.empty()) << "nothing has come yet";
  for (const int azimuth : {0, 18'000, 35'900, 100})
    scan.beginBlock(kStart + 1000 * azimuth, scan.comesRound(azimuth), scans);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(columnsOf(*scans.front()).size(), 0U);
  EXPECT_EQ(toNanoseconds(scans.front()->timestamp), kStart);
}
}  // namespace
