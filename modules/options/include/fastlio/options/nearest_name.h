// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file nearest_name.h Suggestions for names that were mistyped. */
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Fewest insertions, deletions, substitutions and swaps of neighbouring characters that turn \a a
 * into \a b (optimal string alignment distance). */
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

/** True when \a candidate begins with \a name, which has three characters or more: it was not
 * written to its end. */
[[nodiscard]] bool isBeginningOf(std::string_view name, std::string_view candidate);

/** The candidate that was meant by \a name: one that begins with it, else the one with the smallest
 * edit distance, in which letters that \a name lacks count a third; of several the nearest, and the
 * first of equal ones. Empty when there are no candidates. */
[[nodiscard]] std::string_view nearestName(
    std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace fastlio
