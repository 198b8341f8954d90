// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/parsing.h"
#include <fastlio/options/split_text.h>
#include <fastlio/scenarios/realistic.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/scenarios/settings_table.h>

#include <array>
#include <sstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr const char* kFooter = R"(Files in the output directory:
  recording.rawlog  IMU (label 'imu') and LiDAR (label 'lidar'), in the order of their stamps; with
                    gnss.rate also GNSS (label 'gnss'), with wheels.rate wheel odometry (label
                    'wheels')
  ground_truth.tum  true pose of the IMU at 200 Hz
  config.yaml       parameters for fastlio-replay that match the simulated sensors
  scenario.json     all settings, true biases, errors of the sensors, gravity and mounting

Exit status:
  0    written
  1    wrong usage, an unusable setting, or a file that cannot be written or is not ours to replace
  130  interrupted; nothing is written)";

/** An option of its own for a setting that is changed often. */
struct Shorthand
{
  const char* option;
  const char* key;
};

constexpr std::array<Shorthand, 14> kShorthands{{
    {"--duration", "duration"},
    {"--seed", "seed"},
    {"--rest", "rest"},
    {"--speed", "speed"},
    {"--lidar", "lidar.kind"},
    {"--scan-rate", "lidar.rate"},
    {"--range-noise", "lidar.range_noise"},
    {"--dropout", "lidar.dropout"},
    {"--stride", "lidar.stride"},
    {"--time-offset", "lidar.time_offset"},
    {"--lidar-pose", "lidar.pose"},
    {"--imu-rate", "imu.rate"},
    {"--gyro-noise", "imu.gyro_noise"},
    {"--accel-noise", "imu.accel_noise"},
}};

const SettingRow& rowOf(std::string_view key)
{
  for (const auto& row : settingsTable())
    if (row.key == key) return row;
  throw std::logic_error("No setting '" + std::string(key) + "' in the table.");
}

std::string describe(const SettingRow& row)
{
  const std::string unit = row.unit.empty() ? "" : " [" + std::string(row.unit) + "]";
  return std::string(row.effect) + unit;
}

void addShorthand(CLI::App& app, SimCommand& command, const Shorthand& shorthand)
{
  const std::string key = shorthand.key;
  app.add_option_function<std::string>(
         shorthand.option,
         [&command, key](const std::string& value) { command.overrides.emplace_back(key, value); },
         describe(rowOf(key)))
      ->type_name("VALUE")
      ->group("Settings");
}

void addSet(CLI::App& app, SimCommand& command)
{
  const auto add = [&command](const std::vector<std::string>& assignments)
  {
    for (const auto& text : assignments)
    {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw CLI::ValidationError("--set", "expected KEY=VALUE, saw '" + text + "'");
      command.overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
  };
  app.add_option_function<std::vector<std::string>>(
         "--set", add, "Any setting (see --list-settings); may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Settings");
}
}  // namespace

void addOptions(CLI::App& app, SimCommand& command)
{
  addVersion(app, MRPT_FASTLIO_VERSION);
  app.footer(kFooter);
  app.add_option("scenario,-s,--scenario", command.scenario, "What is simulated (see --list)")
      ->type_name("NAME");
  app.add_option(
         "-o,--output-dir", command.output_dir,
         "Directory for the files, created when absent [simulated_NAME]")
      ->type_name("DIR");
  app.add_flag(
      "--overwrite", command.overwrite,
      "Also replace files of these names that fastlio-sim did not write");
  app.add_flag("--list", command.list_scenarios, "List the scenarios");
  app.add_flag(
      "--list-settings", command.list_settings,
      "List the settings with their values for the scenario");
  app.add_flag("-q,--quiet", command.quiet, "Print errors only");
  app.add_flag(
         "--realistic", command.realistic,
         "Sensors with the errors that datasheets admit, drawn from the seed; scenario.json "
         "contains "
         "them, config.yaml does not")
      ->group("Settings");
  for (const auto& shorthand : kShorthands)
    addShorthand(app, command, shorthand);
  addSet(app, command);
}

SimulationSettings settingsOf(const SimCommand& command)
{
  SimulationSettings settings = defaultSettings(command.scenario);
  if (command.realistic) settings = realistic(settings);
  for (const auto& [key, value] : command.overrides)
    settings = withSetting(settings, key, value);
  requireValid(settings);
  return settings;
}

std::string scenarioList()
{
  std::ostringstream text;
  for (const auto& scenario : scenarioTable())
    text << "  " << padded(scenario.name, 12) << scenario.summary << '\n';
  return text.str();
}

std::string settingsList(const SimulationSettings& defaults)
{
  std::ostringstream text;
  for (const auto& row : settingsTable())
    text << row.key << " = " << valueText(row, defaults) << '\n'
         << "    " << describe(row) << "; " << allowedText(row) << '\n';
  return text.str();
}

}  // namespace fastlio
