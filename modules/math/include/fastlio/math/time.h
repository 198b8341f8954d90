// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file time.h Stamps are integer nanoseconds since 1970; seconds are for differences of them. */
#pragma once

#include <cmath>
#include <cstdint>

namespace fastlio
{
constexpr double kNsPerSecond = 1e9;
constexpr std::int64_t kSecondNs = 1'000'000'000;

/** \param duration_ns a difference of stamps, small enough to be exact in a double [ns]
 * \return [s]
 */
[[nodiscard]] constexpr double toSeconds(std::int64_t duration_ns)
{
  return static_cast<double>(duration_ns) * 1e-9;
}

/** The inverse of toSeconds(), rounded.
 * \param duration_s [s]
 * \return [ns] */
[[nodiscard]] inline std::int64_t toNanoseconds(double duration_s)
{
  return std::llround(duration_s * 1e9);
}

/** Later stamps (2112) are no times: the bridge gives 2115 to those that no number can hold. */
constexpr std::int64_t kLatestStamp = 4'500'000'000'000'000'000;

[[nodiscard]] constexpr bool isTime(std::int64_t stamp_ns)
{
  return stamp_ns > 0 && stamp_ns < kLatestStamp;
}

}  // namespace fastlio
