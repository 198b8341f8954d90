// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file folder_formats.h The formats that are folders of files: rows of recordingFormats(). */
#pragma once

#include <fastlio/recordings/recording_reader.h>

#include <vector>

namespace fastlio
{
/** KITTI's folders, folders of clouds, tables of inertial samples. */
[[nodiscard]] const std::vector<RecordingFormat>& folderFormats();

}  // namespace fastlio
