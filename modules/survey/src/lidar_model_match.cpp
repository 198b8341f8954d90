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

// Words of presets that name a maker, or where a sensor was used, but no model.
constexpr std::array<std::string_view, 7> kNoModels = {"ouster",  "livox",     "hesai", "pandar",
                                                       "rslidar", "robosense", "kitti"};

std::string lowerCase(std::string text)
{
  std::transform(
      text.begin(), text.end(), text.begin(),
      [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/** The longest of the preset's words that the label (lower case) contains; empty: none. */
std::string wordIn(const std::string& label, const Preset& preset)
{
  std::istringstream words{std::string(preset.words)};
  std::string longest;
  for (std::string word; words >> word;)
    if (label.find(word) != std::string::npos && word.size() > longest.size()) longest = word;
  return longest;
}

/** The preset with the longest word in the label (lower case); null: none has one. */
const Preset* namedPreset(const std::string& label)
{
  const Preset* named = nullptr;
  std::size_t longest = 0;
  for (const Preset& preset : presetTable())
    if (const std::size_t length = wordIn(label, preset).size(); length > longest)
    {
      named = &preset;
      longest = length;
    }
  return named;
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
  if (const Preset* model = namedModel(lidar.label))
    return {
        model, "the label or the data name it ('" + wordIn(lowerCase(lidar.label), *model) + "')",
        true};
  const Preset* alike = nullptr;
  for (const Preset& preset : presetTable())
  {
    const double now = difference(preset, lidar);
    if (now <= kElevationTolerance && (alike == nullptr || now < difference(*alike, lidar)))
      alike = &preset;
  }
  if (alike != nullptr) return {alike, "it looks like that: " + appearanceText(lidar), false};
  if (const Preset* of_maker = namedPreset(lowerCase(lidar.label)))
    return {of_maker, "the label '" + printable(lidar.label) + "' names its maker", false};
  return {nullptr, "no preset looks like it: " + appearanceText(lidar), false};
}

const Preset* namedModel(const std::string& label)
{
  const std::string lower = lowerCase(label);
  const Preset* named = namedPreset(lower);
  if (named == nullptr) return nullptr;
  const std::string word = wordIn(lower, *named);
  return std::find(kNoModels.begin(), kNoModels.end(), word) == kNoModels.end() ? named : nullptr;
}

bool names(const std::string& label, const Preset& preset)
{
  return !wordIn(lowerCase(label), preset).empty();
}

}  // namespace fastlio
