// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The files of params/ are those of the table, can be loaded, and are found for their sensors.

#include <fastlio/config/config_yaml.h>
#include <fastlio/config/presets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
const fs::path kFolder = fs::path(FASTLIO_SOURCE_DIR) / "params";

std::string textOf(const fs::path& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

fs::path fileOf(const Preset& preset)
{
  return kFolder / (std::string(preset.name) + ".yaml");
}
}  // namespace

TEST(Presets, FilesAreThoseOfTheTable)
{
  std::set<std::string> names;
  for (const Preset& preset : presetTable())
  {
    const std::string text = presetFile(preset);
    if (std::getenv("MRPT_FASTLIO_REGENERATE") != nullptr) std::ofstream(fileOf(preset)) << text;
    EXPECT_EQ(textOf(fileOf(preset)), text) << preset.name << " is out of step; run `make docs`";
    EXPECT_TRUE(names.insert(fileOf(preset).filename().string()).second) << preset.name;
  }
  for (const auto& entry : fs::directory_iterator(kFolder))
  {
    const bool is_preset = entry.path().extension() == ".yaml";
    EXPECT_EQ(names.count(entry.path().filename().string()), is_preset ? 1U : 0U) << entry.path();
  }
}

TEST(Presets, EachIsLoadedAndSaysWhatItIsAbout)
{
  for (const Preset& preset : presetTable())
  {
    const Config config = loadConfigFromFile(fileOf(preset).string());
    const OdometryOptions& p = config.odometry;
    EXPECT_NO_THROW(validate(config)) << preset.name;
    EXPECT_EQ(p.lidar.min_range, preset.min_range) << preset.name;
    EXPECT_EQ(p.lidar.max_range, preset.max_range) << preset.name;
    EXPECT_EQ(p.measurement.range_noise, preset.range_noise) << preset.name;
    // A preset never stands above the poses of a recording.
    EXPECT_FALSE(config.sensors.T_vehicle_imu || config.sensors.T_vehicle_lidar) << preset.name;
    EXPECT_EQ(config.sensors.factory_T_imu_lidar.has_value(), preset.imu.has_value());
    const Vec3 place = config.sensors.factory_T_imu_lidar.value_or(Pose{}).inverse().p;
    EXPECT_LT((place - preset.imu.value_or(Vec3::Zero())).norm(), 1e-9) << preset.name;
    const std::string text = textOf(fileOf(preset));
    const auto lines = std::count(text.begin(), text.end(), '\n');
    EXPECT_GE(lines, 5) << preset.name;
    EXPECT_LE(lines, 25) << preset.name;
    EXPECT_FALSE(preset.source.empty()) << preset.name;
    EXPECT_LT(preset.lowest, preset.highest) << preset.name;
  }
}

TEST(Presets, EachIsFoundByItsLabelAndByItsLooks)
{
  for (const Preset& preset : presetTable())
  {
    std::istringstream words{std::string(preset.words)};
    for (std::string word; words >> word;)
    {
      const PresetMatch match = fittingPreset({"Front_" + word, 0, 0, 0, 1.0});
      ASSERT_NE(match.preset, nullptr) << word;
      EXPECT_EQ(match.preset->name, preset.name) << word;
      EXPECT_EQ(match.named, namedModel("Front_" + word) != nullptr) << word;
    }
    const LidarAppearance looks{
        "lidar", preset.lines, preset.lowest + 0.5, preset.highest - 0.5,
        preset.full_circle ? 1.0 : 0.2};
    const PresetMatch match = fittingPreset(looks);
    ASSERT_NE(match.preset, nullptr) << preset.name;
    EXPECT_EQ(match.preset->lowest, preset.lowest) << preset.name << " " << match.preset->name;
    EXPECT_EQ(match.preset->full_circle, preset.full_circle);
    EXPECT_FALSE(match.named);
  }
  EXPECT_EQ(fittingPreset({"lidar", 4, -2, 2, 0.3}).preset, nullptr);
  // The label of a capture names the maker, not the model.
  const PresetMatch os0 = fittingPreset({"ouster_192.168.1.10", 0, -45, 45, 1.0});
  ASSERT_NE(os0.preset, nullptr);
  EXPECT_EQ(os0.preset->name, "ouster_os0");
  // In a street the upper beams meet the sky; the lower ones always meet the ground.
  ASSERT_NE(fittingPreset({"lidar", 64, -24.9, 8.0, 1.0}).preset, nullptr);
  EXPECT_EQ(fittingPreset({"lidar", 64, -24.9, 8.0, 1.0}).preset->name, "hesai_pandar64");
  EXPECT_EQ(fittingPreset({"lidar", 64, -17.5, 15.0, 1.0}).preset, nullptr);
}

}  // namespace fastlio
