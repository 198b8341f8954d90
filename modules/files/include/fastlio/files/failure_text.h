// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file failure_text.h The text of an exception for people. */
#pragma once

#include <exception>
#include <string>

namespace fastlio
{
/** The message; in words where the standard library's own does not say what was missing: memory, a
 * thread. */
[[nodiscard]] std::string failureText(const std::exception& failure);

}  // namespace fastlio
