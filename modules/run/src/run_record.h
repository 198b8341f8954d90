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
/** What a run has left in a folder. */
struct RunRecord
{
  std::vector<OutputFile> outputs;
  std::string program;  //!< that wrote it; empty: the record does not say
};

/** Reads a record, a JSON document.
 * \param key that records of the program have at the top
 * \return nothing when the file is not there or something else */
[[nodiscard]] std::optional<RunRecord> readRunRecord(
    const std::string& path, const std::string& key);

}  // namespace fastlio
