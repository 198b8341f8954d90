// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file epoch.h Limits of times since 1970 (internal). */
#pragma once

#include <cstdint>

namespace fastlio
{
constexpr std::int64_t kLastEpoch = 9'000'000'000;  // [s], in the range of 64-bit nanoseconds

}  // namespace fastlio
