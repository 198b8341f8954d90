// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file split_text.h Parts of a line, which point into its text, and parts as one text. */
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Without the blanks around: spaces, tabs, ends of lines. */
[[nodiscard]] std::string_view trimmed(std::string_view text);

/** The words between blanks; at most so many, whatever the length of the text is. */
[[nodiscard]] std::vector<std::string_view> splitAtBlanks(
    std::string_view text, std::size_t most = std::string_view::npos);

/** The parts between commas, trimmed: one more than there are commas. */
[[nodiscard]] std::vector<std::string_view> splitAtCommas(std::string_view text);

/** The parts one behind the other. \param separator between each two */
[[nodiscard]] std::string joined(
    const std::vector<std::string>& parts, std::string_view separator = ", ");

/** With blanks behind it, up to so many bytes; a longer text as it is. */
[[nodiscard]] std::string padded(std::string_view text, std::size_t width);

}  // namespace fastlio
