// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plausible_time.h Stamps that can be times at all. */
#pragma once

#include <cstdint>

namespace fastlio
{
/** Later stamps (2112) are no times: the bridge gives 2115 to those that no number can hold. */
constexpr std::int64_t kLatestStamp = 4'500'000'000'000'000'000;

[[nodiscard]] constexpr bool isTime(std::int64_t stamp_ns)
{
  return stamp_ns > 0 && stamp_ns < kLatestStamp;
}

}  // namespace fastlio
