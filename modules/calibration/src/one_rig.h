// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file one_rig.h Whether recordings are of the same rig (internal). */
#pragma once

#include <fastlio/calibration/calibration_run.h>
#include <fastlio/survey/sensor_selection.h>

#include <vector>

namespace fastlio
{
/** Compares the LiDAR and the poses of LiDAR and IMU with those of the first recording.
 * \exception std::runtime_error they differ; names both recordings and what differs */
void requireOneRig(const std::vector<CalibrationRecording>& recordings, const Config& config);

}  // namespace fastlio
