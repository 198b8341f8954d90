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

/** The candidate with the smallest edit distance, the first of them when there are several; empty
 * when there are no candidates. */
[[nodiscard]] std::string_view nearestName(
    std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace fastlio
