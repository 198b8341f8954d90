// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file capture_formats.h The formats of captures of a network: rows of recordingFormats(). */
#pragma once

#include <fastlio/recordings/recording_reader.h>

#include <vector>

namespace fastlio
{
/** Files with the packets of LiDARs. */
[[nodiscard]] const std::vector<RecordingFormat>& captureFormats();

}  // namespace fastlio
