// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/printable.h>
#include <fastlio/survey/lidar_models.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace fastlio
{
namespace
{
constexpr double kFullCircle = 0.9;          // fraction of the azimuths
constexpr double kElevationTolerance = 4.0;  // [deg]
// The sky returns nothing: what is missing at the upper edge counts less, which allows ten degrees.
constexpr double kMissingSky = 0.4;

std::string lowerCase(std::string text)
{
  std::transform(
      text.begin(), text.end(), text.begin(),
      [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/** Length of the longest of the preset's words that the label contains; 0: none. */
std::size_t namedBy(const Preset& preset, const std::string& label)
{
  std::istringstream words{std::string(preset.words)};
  std::size_t longest = 0;
  for (std::string word; words >> word;)
    if (label.find(word) != std::string::npos) longest = std::max(longest, word.size());
  return longest;
}

/** Difference of the field of view [deg]; infinite when lines or circle say no. */
double difference(const Preset& preset, const LidarAppearance& lidar)
{
  constexpr double kNever = 1e9;
  if (preset.full_circle != (lidar.coverage >= kFullCircle)) return kNever;
  if (preset.lines > 0 && lidar.lines > 0 && preset.lines != lidar.lines) return kNever;
  const double missing = preset.highest - lidar.highest;
  const double upper = missing > 0.0 ? kMissingSky * missing : -missing;
  return std::max(std::abs(preset.lowest - lidar.lowest), upper);
}

std::string appearanceText(const LidarAppearance& lidar)
{
  std::array<char, 120> text{};
  const std::string lines = lidar.lines > 0 ? std::to_string(lidar.lines) + " lines, " : "";
  std::snprintf(
      text.data(), text.size(), "%selevations %.0f to %.0f deg, %.0f %% of the azimuths",
      lines.c_str(), lidar.lowest, lidar.highest, 100.0 * lidar.coverage);
  return text.data();
}
}  // namespace

PresetMatch fittingPreset(const LidarAppearance& lidar)
{
  const std::string label = lowerCase(lidar.label);
  const Preset* named = nullptr;
  const Preset* alike = nullptr;
  for (const Preset& preset : presetTable())
  {
    const std::size_t length = namedBy(preset, label);
    if (length > 0 && (named == nullptr || length > namedBy(*named, label))) named = &preset;
    const double now = difference(preset, lidar);
    if (now <= kElevationTolerance && (alike == nullptr || now < difference(*alike, lidar)))
      alike = &preset;
  }
  if (named != nullptr)
    return {named, "the label or model '" + printable(lidar.label) + "' names it", true};
  if (alike != nullptr) return {alike, "it looks like that: " + appearanceText(lidar), false};
  return {nullptr, "no preset looks like it: " + appearanceText(lidar), false};
}

}  // namespace fastlio
