// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mrpt_messages.h The gist of MRPT's exceptions. */
#pragma once

#include <string>

namespace fastlio
{
/** MRPT stacks the messages of nested exceptions, the innermost last, each with a call stack behind
 * it: the one line that says what happened. */
[[nodiscard]] std::string innermostMessage(const std::string& what);

}  // namespace fastlio
