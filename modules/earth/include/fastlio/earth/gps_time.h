// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gps_time.h Stamps as times of the GPS, which knows no leap seconds. */
#pragma once

#include <cstdint>

namespace fastlio
{
/** GPS time minus UTC at a stamp [s]: 0 in 1980, 18 since 2017-01-01 (IERS Bulletin C; none is
 * announced since). A leap second itself counts as the second after it. */
[[nodiscard]] int leapSecondsAt(std::int64_t stamp_ns);

/** Seconds of GPS time since 1980-01-06 minus 1e9, as LAS files hold them; a double resolves 60 ns
 * of today's. Stamps of clocks that do not count from 1970 become negative numbers with right
 * differences.
 * \param stamp_ns nanoseconds of UTC since 1970 */
[[nodiscard]] double adjustedGpsTime(std::int64_t stamp_ns);

}  // namespace fastlio
