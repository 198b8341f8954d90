// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file conversions.h Time and poses between MRPT's types and our own. */
#pragma once

#include <fastlio/math/pose.h>

#include <mrpt/core/Clock.h>
#include <mrpt/poses/CPose3D.h>

#include <cstdint>

namespace fastlio
{
/** Nanoseconds since the UNIX epoch; MRPT's clock ticks in units of 100 ns. Stamps more than 146
 * years from 1970 (INVALID_TIMESTAMP, corrupt ones) are brought to that limit. */
[[nodiscard]] std::int64_t toNanoseconds(const mrpt::Clock::time_point& stamp);

/** The inverse of toNanoseconds(), rounded to the nearest tick of 100 ns. */
[[nodiscard]] mrpt::Clock::time_point toMrptTime(std::int64_t stamp_ns);

[[nodiscard]] Pose toPose(const mrpt::poses::CPose3D& T_a_b);
[[nodiscard]] mrpt::poses::CPose3D toMrptPose(const Pose& T_a_b);

}  // namespace fastlio
