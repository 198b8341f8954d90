// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file readable_recordings.h Whether the recordings that the user names are there. */
#pragma once

#include <fastlio/options/printable.h>
#include <fastlio/rawlog/recording_formats.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio
{
/** \exception std::runtime_error names the first one that does not exist, or is no file and no
 * folder of a known format */
inline void requireReadableRecordings(const std::vector<std::string>& files)
{
  for (const std::string& file : files)
    if (const auto problem = recordingProblem(file))
      throw std::runtime_error("the recording '" + printable(file) + "' " + *problem);
}

}  // namespace fastlio
