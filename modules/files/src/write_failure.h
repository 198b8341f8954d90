// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file write_failure.h The message when a file cannot be written. */
#pragma once

#include <string>

namespace fastlio
{
/** \exception std::runtime_error always; the reason is that of errno */
[[noreturn]] void failWriting(const std::string& path);
[[noreturn]] void failWriting(const std::string& path, const std::string& reason);

}  // namespace fastlio
