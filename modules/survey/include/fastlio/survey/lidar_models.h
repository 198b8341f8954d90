// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_models.h Common LiDARs with the figures of their makers, from which the presets in
 * params/ are made. */
#pragma once

#include <fastlio/math/so3.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** One LiDAR with the figures of its maker. */
struct Preset
{
  std::string_view name;        //!< of the file params/NAME.yaml
  std::string_view title;       //!< maker and models
  std::string_view words;       //!< what sensor labels may contain, lower case, separated by blanks
  int lines = 0;                //!< laser lines; 0: any number, or a pattern without lines
  double lowest = 0;            //!< elevation of the lowest beam [deg]
  double highest = 0;           //!< of the highest [deg]
  bool full_circle = true;      //!< sees all around
  double min_range = 0.5;       //!< blind zone [m]
  double max_range = 150.0;     //!< [m]
  double range_noise = 0.02;    //!< standard deviation of a range, of the map's planes, too [m]
  std::optional<Vec3> imu;      //!< place of the built-in IMU in the frame of the points [m]
  std::string_view source;      //!< of the figures
  std::string_view diagnostic;  //!< what else to know; may be empty
};

/** All presets, by maker. */
[[nodiscard]] const std::vector<Preset>& presetTable();

/** Properties of a LiDAR in a recording. */
struct LidarAppearance
{
  std::string label;    //!< of the sensor, and its model if known
  int lines = 0;        //!< 0: unknown
  double lowest = 0;    //!< elevations [deg]
  double highest = 0;   //!< [deg]
  double coverage = 0;  //!< fraction of the azimuths with points, 0..1
};

/** A preset and how well it fits. */
struct PresetMatch
{
  const Preset* preset = nullptr;  //!< null: none fits
  std::string reason;              //!< for people
  bool named = false;              //!< the label names the sensor
};

/** The preset that fits best: by the label, else by the lines and the field of view. */
[[nodiscard]] PresetMatch fittingPreset(const LidarAppearance& lidar);

/** The preset of the model that the label of a LiDAR, or its data, name. Null: none is named, or
 * only its maker. */
[[nodiscard]] const Preset* namedModel(const std::string& label);

/** Whether a label has one of the preset's words: its model or its maker. */
[[nodiscard]] bool names(const std::string& label, const Preset& preset);

}  // namespace fastlio
