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
/** How times follow each other [s]. */
struct StampRhythm
{
  double usual = 0, longest = 0;  //!< step, of which the second one is rare
};
inline constexpr StampRhythm kCloudRhythm{0.1, 100.0}, kSampleRhythm{0.005, 0.5};

/** What numbers count [ns]: one unit for all times of a file or of a list of names. Seconds, where
 * one has decimals. Of whole numbers the unit in which the newest is a date of our days and they
 * follow each other as they should; of a clock that counts from something else, the one in which
 * they follow each other most like the usual step.
 * \param texts in any order; what is no number is left alone */
[[nodiscard]] std::int64_t stampUnitOf(
    const std::vector<std::string>& texts, const StampRhythm& rhythm);

/** Nanoseconds since 1970 from "2011-09-26 13:02:25.594360375" (read as UTC), or from a number of
 * \a unit_ns, also with decimals or an exponent. Decimals are exact. Nothing behind 2112. */
[[nodiscard]] std::optional<std::int64_t> stampOf(std::string_view text, std::int64_t unit_ns);

/** The first word of each line, as far as they are times of clouds. */
[[nodiscard]] std::vector<std::int64_t> stampsOfFile(const std::string& path);

}  // namespace fastlio
