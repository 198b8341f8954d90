// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file presets.h The files of params/: what common LiDARs need beside the defaults. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/sensors/sensor_summary.h>
#include <fastlio/survey/lidar_models.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** The defaults with what the LiDAR needs. */
[[nodiscard]] Config configOf(const Preset& preset);

/** The file params/NAME.yaml: ranges, noise, the mounting of a built-in IMU, and their sources. */
[[nodiscard]] std::string presetFile(const Preset& preset);

/** The values that a configuration took from a preset. */
struct PresetUse
{
  std::string name;               //!< of the preset
  std::vector<std::string> keys;  //!< whose values it changed; empty: they are the defaults
  std::string text;               //!< for people
};

/** Gives a configuration the values of the LiDAR whose model the recording names. A value that the
 * user gave stays. The mounting of a built-in IMU needs an IMU whose label names the same sensor.
 * \param is_given whether the user gave a key
 * \return nothing: the recording names no model that has a preset */
std::optional<PresetUse> takePreset(
    const SensorSelection& selection, const std::function<bool(std::string_view)>& is_given,
    Config& config);

}  // namespace fastlio
