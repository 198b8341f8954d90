// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file settings_table.h One row per setting: the single source of the command line, the checks,
 * the lists and scenario.json. A new setting is one struct member and one row. */
#pragma once

#include <fastlio/options/option_table.h>
#include <fastlio/scenarios/settings.h>

#include <string>
#include <string_view>

namespace fastlio
{
using SettingRow = OptionRow<SimulationSettings>;

[[nodiscard]] const OptionTable<SimulationSettings>& settingsTable();

/** The settings with one of them changed. \param text a number, a name, true/false, or numbers
 * separated by commas, with or without brackets
 * \exception std::invalid_argument unknown key (the message gives the nearest one), or a text that
 * is not a value in the allowed range */
[[nodiscard]] SimulationSettings withSetting(
    SimulationSettings settings, std::string_view key, std::string_view text);

/** Checks all ranges, for settings that were made in code.
 * \exception std::invalid_argument names the settings out of range and what is allowed */
void requireValid(const SimulationSettings& settings);

}  // namespace fastlio
