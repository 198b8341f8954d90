// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file settings_table.h One row per setting: the single source of the command line, the checks,
 * the lists and scenario.json. A new setting is one struct member and one row. */
#pragma once

#include <fastlio/simulation/settings.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fastlio
{
/** Access to a member. */
template <typename T>
using SettingMember = T* (*)(SimulationSettings&);

/** A finite number; member = si_per_unit * number in the text. */
struct RealSetting
{
  SettingMember<double> member;
  double min, max;  //!< both allowed, in the unit of the text
  double si_per_unit = 1.0;
};

struct CountSetting
{
  SettingMember<int> member;
  int min, max;
};

struct SeedSetting
{
  SettingMember<std::uint64_t> member;
};

/** Whole seconds, held in nanoseconds. */
struct EpochSetting
{
  SettingMember<std::int64_t> member;
};

struct SwitchSetting
{
  SettingMember<bool> member;
};

/** One of the names in lidarKindNames(). */
struct KindSetting
{
  SettingMember<LidarKind> member;
};

/** One of several names; the i-th stands for the enumerator with the value i. */
struct ChoiceSetting
{
  std::vector<std::string_view> names;
  std::size_t (*read)(const SimulationSettings&);
  void (*write)(SimulationSettings&, std::size_t);
};

/** Three finite numbers. */
struct VectorSetting
{
  SettingMember<Vec3> member;
};

/** x, y, z [m], yaw, pitch, roll [deg]. */
struct PoseSetting
{
  SettingMember<Pose> member;
};

using SettingValue = std::variant<
    RealSetting, CountSetting, SeedSetting, EpochSetting, SwitchSetting, KindSetting, ChoiceSetting,
    VectorSetting, PoseSetting>;

/** One setting. */
struct SettingRow
{
  std::string_view key;   //!< `name` or `group.name`
  std::string_view unit;  //!< of the text; empty when there is none
  SettingValue value;
  std::string_view effect;
};

[[nodiscard]] const std::vector<SettingRow>& settingsTable();

/** Names of LidarKind in the order of its enumerators: vlp16, os64, livox. */
[[nodiscard]] const std::vector<std::string_view>& lidarKindNames();

/** The settings with one of them changed. \param text a number, a name, true/false, or numbers
 * separated by commas
 * \exception std::invalid_argument unknown key (the message gives the nearest one), or a text that
 * is not a value in the allowed range */
[[nodiscard]] SimulationSettings withSetting(
    SimulationSettings settings, std::string_view key, std::string_view text);

/** A setting's value as withSetting() takes it. */
[[nodiscard]] std::string settingText(const SettingRow& row, const SimulationSettings& settings);

/** Allowed values of a setting in words. */
[[nodiscard]] std::string allowedValues(const SettingRow& row);

/** Checks all ranges, for settings that were made in code.
 * \exception std::invalid_argument names the settings out of range and what is allowed */
void requireValid(const SimulationSettings& settings);

}  // namespace fastlio
