// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bag_formats.h The formats of bags: rows of recordingFormats(). */
#pragma once

#include <fastlio/recordings/recording_reader.h>

#include <vector>

namespace fastlio
{
/** Files and folders with messages of ROS 1 or ROS 2. */
[[nodiscard]] const std::vector<RecordingFormat>& bagFormats();

}  // namespace fastlio
