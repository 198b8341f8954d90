// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file printable.h Text of others, made fit for a terminal, a log or a table. */
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fastlio
{
/** Bytes of foreign text that a message shows: a path or a label in full, and no screen of it. */
inline constexpr std::size_t kLongestShown = 200;

/** \a text in one line of valid UTF-8 that moves no cursor, changes no colour and turns no
 * direction of writing: control characters, marks of direction and bytes that are no UTF-8 become
 * \\n, \\t, \\r or \\xNN, byte by byte. What is longer than \a longest ends in its length. */
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = kLongestShown);

}  // namespace fastlio
