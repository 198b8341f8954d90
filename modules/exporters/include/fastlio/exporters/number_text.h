// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file number_text.h Numbers as text, the same in every locale. */
#pragma once

#include <cstdint>
#include <string>

namespace fastlio
{
/** Seconds with 9 decimals from integer nanoseconds, exact: 1403636580838555648 ->
 * "1403636580.838555648". */
[[nodiscard]] std::string secondsText(std::int64_t stamp_ns);

/** Fixed notation with \a decimals digits after the point ("nan", "inf" when not finite). */
[[nodiscard]] std::string fixedText(double value, int decimals);

/** The shortest text that reads back to the same double ("nan", "inf" when not finite). */
[[nodiscard]] std::string roundTripText(double value);

}  // namespace fastlio
