// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/gps_time.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace fastlio
{
namespace
{
TEST(GpsTime, LeapSecondsAreThoseOfTheTimeZoneData)
{
  std::ifstream list("/usr/share/zoneinfo/leap-seconds.list");
  if (!list) GTEST_SKIP() << "needs Debian's tzdata";
  constexpr std::int64_t kNtpEpoch = 2'208'988'800;  // 1900 to 1970 [s]
  int checked = 0;
  for (std::string line; std::getline(list, line);)
  {
    std::istringstream row(line);
    std::int64_t since_1900 = 0;
    int from_tai = 0;
    if (line.empty() || line[0] == '#' || !(row >> since_1900 >> from_tai) || from_tai < 20)
      continue;
    // GPS is 19 s behind atomic time.
    const std::int64_t begin_ns = (since_1900 - kNtpEpoch) * 1'000'000'000;
    EXPECT_EQ(leapSecondsAt(begin_ns), from_tai - 19) << line;
    EXPECT_EQ(leapSecondsAt(begin_ns - 1), from_tai - 20) << line;
    ++checked;
  }
  EXPECT_EQ(checked, 18);
}

TEST(GpsTime, KnownTimes)
{
  // 2011-09-14 01:46:25 UTC is GPS second 1e9, with 15 leap seconds.
  EXPECT_EQ(adjustedGpsTime(1'315'964'785'000'000'000), 0.0);
  EXPECT_EQ(adjustedGpsTime(1'315'964'785'500'000'000), 0.5);
  EXPECT_NEAR(adjustedGpsTime(1'700'000'000'123'456'789), 384'035'218.123456789, 1e-7);
  EXPECT_EQ(adjustedGpsTime(315'964'800'000'000'000), -1e9);
}

TEST(GpsTime, DifferencesOfOtherClocksAreRight)
{
  EXPECT_NEAR(adjustedGpsTime(2'500'000'000) - adjustedGpsTime(1'000'000'000), 1.5, 1e-6);
  EXPECT_NEAR(adjustedGpsTime(1'000'000'000) - adjustedGpsTime(-500'000'000), 1.5, 1e-6);
}
}  // namespace
}  // namespace fastlio
