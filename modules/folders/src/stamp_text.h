// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file stamp_text.h Times as people write them into files and names of files. */
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Nanoseconds since 1970 from "2011-09-26 13:02:25.594360375" (read as UTC), seconds with decimals
 * or an exponent, or a whole number whose size determines its unit: s, ms, us or ns. Decimals are
 * exact.
 */
[[nodiscard]] std::optional<std::int64_t> stampOf(std::string_view text);

/** The first word of each line, as far as they are times. */
[[nodiscard]] std::vector<std::int64_t> stampsOfFile(const std::string& path);

}  // namespace fastlio
