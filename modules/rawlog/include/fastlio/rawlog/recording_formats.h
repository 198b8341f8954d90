// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_formats.h The table of all formats of recordings. */
#pragma once

#include <fastlio/recordings/recording_reader.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** All formats but rawlogs. */
[[nodiscard]] const std::vector<RecordingFormat>& recordingFormats();

/** The format of a file or folder; null: none of the table. */
[[nodiscard]] const RecordingFormat* recordingFormatOf(const std::string& path);

/** Why there is no recording to be read; nothing: a folder of the table, or any file. The words
 * continue a sentence that begins with the path. */
[[nodiscard]] std::optional<std::string> recordingProblem(const std::string& path);

}  // namespace fastlio
