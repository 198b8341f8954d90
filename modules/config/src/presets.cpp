// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/presets.h>

#include <array>
#include <sstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kColumns = 100;

/** The keys that a preset sets. */
constexpr std::array<std::string_view, 4> kPresetKeys = {
    "input.factory_T_imu_lidar", "lidar.min_range", "lidar.max_range", "measurement.range_noise"};

/** Comment lines of at most kColumns characters. */
std::string comment(const std::string& text)
{
  std::istringstream words(text);
  std::string lines, line = "#";
  for (std::string word; words >> word;)
  {
    if (line.size() + 1 + word.size() > kColumns)
    {
      lines += line + "\n";
      line = "#";
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

std::string headerOf(const Preset& preset)
{
  std::string text = comment(std::string(preset.title) + ".");
  text += comment("Figures: " + std::string(preset.source) + ".");
  if (preset.imu)
    text += comment(
        "factory_T_imu_lidar is for the built-in IMU, in a recording without the poses of its "
        "sensors.");
  if (!preset.diagnostic.empty()) text += comment(std::string(preset.diagnostic) + ".");
  return text + comment("All other parameters keep their defaults (docs/parameters.md).");
}

std::string useText(const Preset& preset, const PresetUse& use, const Config& config)
{
  std::string changes;
  for (const std::string& key : use.keys)
    changes += (changes.empty() ? "" : ", ") + key + ": " +
               valueText(*findOption(configTable(), key), config);
  return "The recording names its LiDAR, " + std::string(preset.title) + ": the values of params/" +
         use.name + ".yaml are in use (" +
         (changes.empty() ? "they are the defaults, or given otherwise" : changes) + ").";
}
}  // namespace

Config configOf(const Preset& preset)
{
  Config config;
  config.odometry.lidar.min_range = preset.min_range;
  config.odometry.lidar.max_range = preset.max_range;
  config.odometry.measurement.range_noise = preset.range_noise;
  // The axes of a built-in IMU are those of the points.
  if (preset.imu) config.sensors.factory_T_imu_lidar = Pose{Mat3::Identity(), -*preset.imu};
  return config;
}

std::string presetFile(const Preset& preset)
{
  const Config config = configOf(preset);
  std::string text = headerOf(preset);
  std::string_view group;
  for (const std::string_view key : kPresetKeys)
  {
    const std::string value = valueText(*findOption(configTable(), key), config);
    if (value == "null") continue;
    if (groupOf(key) != group) text += std::string(groupOf(key)) + ":\n";
    group = groupOf(key);
    text += "  " + std::string(nameOf(key)) + ": " + value + "\n";
  }
  return text;
}

std::optional<PresetUse> takePreset(
    const SensorSelection& selection, const std::function<bool(std::string_view)>& is_given,
    Config& config)
{
  const Preset* preset = namedModel(selection.lidar.label + " " + selection.lidar.detail);
  if (preset == nullptr) return std::nullopt;
  PresetUse use{std::string(preset->name), {}, {}};
  const Config values = configOf(*preset);
  for (const std::string_view key : kPresetKeys)
  {
    const auto& row = *findOption(configTable(), key);
    const std::string value = valueText(row, values);
    const bool fits = key != kPresetKeys.front() || names(selection.imu.label, *preset);
    if (is_given(key) || !fits || value == valueText(row, config)) continue;
    if (const auto problem = assign(row.value(config), row.unit, value))
      throw std::logic_error(std::string(key) + ": " + *problem);
    use.keys.emplace_back(key);
  }
  use.text = useText(*preset, use, config);
  return use;
}

}  // namespace fastlio
