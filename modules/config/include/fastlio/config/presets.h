// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file presets.h The files of params/: what common LiDARs need beside the defaults. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/survey/lidar_models.h>

#include <string>

namespace fastlio
{
/** The defaults with what the LiDAR needs. */
[[nodiscard]] Config configOf(const Preset& preset);

/** The file params/NAME.yaml: ranges, noise, the mounting of a built-in IMU, and their sources. */
[[nodiscard]] std::string presetFile(const Preset& preset);

}  // namespace fastlio
