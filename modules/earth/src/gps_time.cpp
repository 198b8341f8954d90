// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/gps_time.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <array>

namespace fastlio
{
namespace
{
constexpr std::int64_t kGpsEpoch = 315'964'800;  // 1980-01-06 in seconds since 1970
constexpr std::int64_t kAdjustment = 1'000'000'000;

/** The seconds since 1970 from which on GPS is one second further ahead of UTC. */
constexpr std::array<std::int64_t, 18> kLeaps = {
    362'793'600,    // 1981-07-01
    394'329'600,    // 1982-07-01
    425'865'600,    // 1983-07-01
    489'024'000,    // 1985-07-01
    567'993'600,    // 1988-01-01
    631'152'000,    // 1990-01-01
    662'688'000,    // 1991-01-01
    709'948'800,    // 1992-07-01
    741'484'800,    // 1993-07-01
    773'020'800,    // 1994-07-01
    820'454'400,    // 1996-01-01
    867'715'200,    // 1997-07-01
    915'148'800,    // 1999-01-01
    1'136'073'600,  // 2006-01-01
    1'230'768'000,  // 2009-01-01
    1'341'100'800,  // 2012-07-01
    1'435'708'800,  // 2015-07-01
    1'483'228'800,  // 2017-01-01
};
}  // namespace

int leapSecondsAt(std::int64_t stamp_ns)
{
  const auto* const passed = std::upper_bound(
      kLeaps.begin(), kLeaps.end(), stamp_ns,
      [](std::int64_t stamp, std::int64_t leap) { return stamp < leap * kSecondNs; });
  return static_cast<int>(passed - kLeaps.begin());
}

double adjustedGpsTime(std::int64_t stamp_ns)
{
  // Whole seconds apart from the rest: their sum is rounded once.
  const std::int64_t seconds = stamp_ns / kSecondNs;
  const std::int64_t rest = stamp_ns % kSecondNs;
  return static_cast<double>(seconds - kGpsEpoch - kAdjustment + leapSecondsAt(stamp_ns)) +
         toSeconds(rest);
}

}  // namespace fastlio
