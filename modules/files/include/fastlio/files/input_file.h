// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file input_file.h Whether a path is a file that can be read as often as needed. */
#pragma once

#include <optional>
#include <string>

namespace fastlio
{
/** Why \a path cannot be read as a file: it does not exist, is a folder, a pipe, a device, a
 * socket, or may not be read. Goes on behind its name: "'x' is a folder". Nothing is opened that
 * could block, and nothing is read. */
[[nodiscard]] std::optional<std::string> inputFileProblem(const std::string& path);

}  // namespace fastlio
