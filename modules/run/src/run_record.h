// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_record.h Which files an earlier run has written, by its own record. */
#pragma once

#include <fastlio/files/atomic_file.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The "outputs" of a record, a JSON document.
 * \param key that records of the program have at the top
 * \return nothing when the file is not there or something else */
[[nodiscard]] std::optional<std::vector<OutputFile>> outputsOfRecord(
    const std::string& path, const std::string& key);

}  // namespace fastlio
