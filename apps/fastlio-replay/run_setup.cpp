// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_setup.h"

#include "../shared/failure.h"
#include "../shared/readable_recordings.h"
#include <fastlio/calibration/calibration_report.h>
#include <fastlio/config/config_document.h>
#include <fastlio/config/config_yaml.h>
#include <fastlio/config/presets.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/files/failure_text.h>
#include <fastlio/files/input_file.h>
#include <fastlio/files/same_file.h>
#include <fastlio/math/angles.h>
#include <fastlio/options/nearest_name.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>
#include <fastlio/report/report_reference.h>
#include <fastlio/savedmaps/saved_map_file.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/survey/recording_parts.h>
#include <fastlio/survey/sensor_selection.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace fastlio
{
namespace
{
constexpr double kLargestPoseNumber = 1e7;  // beyond the coordinates of any grid, UTM for instance

/** A configuration and what changed it. */
struct Loaded
{
  ConfigFile file;                             //!< its configuration with the changes below
  std::map<std::string, std::string> origins;  //!< of the keys that others than the file changed

  [[nodiscard]] bool gives(std::string_view key) const
  {
    return origins.count(std::string(key)) > 0 || file.lines.count(std::string(key)) > 0;
  }
};

ConfigFile readFile(const ReplayArguments& arguments)
{
  return failingWith(
      ExitStatus::Usage,
      [&]
      {
        return arguments.parameters.config_file.empty()
                   ? ConfigFile{}
                   : readConfigFile(arguments.parameters.config_file);
      });
}

/** The command line goes before the file, and its own options before --set. */
Loaded loadConfiguration(const ReplayArguments& arguments)
{
  Loaded loaded{readFile(arguments), {}};
  failingWith(
      ExitStatus::Usage,
      [&]
      {
        for (const std::string& setting : arguments.parameters.settings)
          loaded.origins[applySetting(setting, loaded.file.config)] = "--set";
      });
  OdometryOptions& odometry = loaded.file.config.odometry;
  SensorOptions& sensors = loaded.file.config.sensors;
  std::string& exporters = loaded.file.config.exporters.exporters;
  const auto set = [&loaded](const char* key, const char* option, auto& member, const auto& value)
  {
    member = value;
    loaded.origins[key] = std::string("command line, ") + option;
  };
  if (arguments.threads) set("threads", "--threads", odometry.threads, *arguments.threads);
  if (arguments.no_map_update) set("map.update", "--no-map-update", odometry.map.update, false);
  if (!arguments.exporters.empty())
    set("output.exporters", "--export", exporters, joined(arguments.exporters, ","));
  const auto names = splitAtCommas(exporters);
  if (arguments.imu_rate)
    set("output.imu_rate", "--imu-rate", odometry.imu_rate, true);
  else if (std::count(names.begin(), names.end(), "imu_rate") > 0 && !odometry.imu_rate)
  {
    odometry.imu_rate = true;
    loaded.origins["output.imu_rate"] = "output.exporters names imu_rate";
  }
  if (arguments.lidar_sensor_label)
    set("input.lidar_sensor_label", "--lidar-sensor-label", sensors.lidar_sensor_label,
        *arguments.lidar_sensor_label);
  if (arguments.imu_sensor_label)
    set("input.imu_sensor_label", "--imu-sensor-label", sensors.imu_sensor_label,
        *arguments.imu_sensor_label);
  return loaded;
}

/** Without what would end a comment. */
std::string inOneLine(std::string text)
{
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return text;
}

/** A reference that is named has to be one; the page alone would say that it is not. */
void requireReference(const std::string& file)
{
  if (file.empty()) return;
  const auto refuse = [&file](const std::string& why)
  { throw Failure(ExitStatus::Usage, "--reference '" + printable(file) + "' " + why); };
  if (const auto problem = inputFileProblem(file)) refuse(*problem);
  if (std::filesystem::file_size(file) > ReferenceComparison::kLargestFile) return;
  try
  {
    (void)readTrajectory(file);
  }
  catch (const std::exception& e)
  {
    refuse("cannot be used: " + failureText(e));
  }
}

template <typename Step>
auto checked(Step step)
{
  return failingWith(ExitStatus::Usage, ExitStatus::InputUnusable, step);
}

/** The sensors of the recording. \exception Failure none can be used */
SensorSelection sensorsOf(const ReplayArguments& arguments, const Config& config)
{
  return checked([&] { return sensorsIn(arguments.input_files, config.sensors); });
}

/** Takes in the preset of the LiDAR that the recording names. \return its name and a note */
std::optional<PresetUse> takePreset(const SensorSelection& selection, Loaded& loaded)
{
  const auto is_given = [&loaded](std::string_view key) { return loaded.gives(key); };
  auto use = takePreset(selection, is_given, loaded.file.config);
  if (use)
    for (const std::string& key : use->keys)
      loaded.origins[key] = "preset " + use->name + ", whose LiDAR the recording names";
  return use;
}

/** The pose of the body that is written about, as the user gives it. */
Pose poseOf(const std::vector<double>& numbers)
{
  if (numbers.empty()) return {};
  for (const double number : numbers)
    if (!(std::abs(number) <= kLargestPoseNumber))
      throw Failure(
          ExitStatus::Usage,
          "--initial-pose has a number that is not between -1e7 and 1e7 [m, deg]");
  return toPose(mrpt::poses::CPose3D(
      numbers[0], numbers[1], numbers[2], kRadPerDeg * numbers[3], kRadPerDeg * numbers[4],
      kRadPerDeg * numbers[5]));
}

std::optional<SavedMap> savedMapOf(const ReplayArguments& arguments, const OutputFrame& frame)
{
  if (arguments.map_in.empty()) return std::nullopt;
  return failingWith(
      ExitStatus::InputUnusable,
      [&]
      {
        SavedMap saved = loadSavedMap(arguments.map_in);
        if (!arguments.initial_pose.empty())
          saved.T_map_imu = poseOf(arguments.initial_pose) * frame.T_imu_body.inverse();
        return std::optional(std::move(saved));
      });
}

/** --calibrate: tries the result on the last part of the recording; where that is better, \a config
 * gets it. \return what was found, for people */
std::string calibrateFirst(const std::vector<std::string>& files, Config& config)
{
  constexpr int kPasses = 8;  // as fastlio-calibrate
  const std::string name = std::filesystem::path(files.front()).filename().string();
  const Calibrator calibrator({{name, files}}, config, kPasses);
  const RigEstimate estimate = calibrator.calibrate();
  const CalibrationTrial trial = calibrator.tryOut();
  if (trial.worthUsing()) config = calibrator.configWith(estimate);
  const std::string start = describeStart(estimate);
  return "Calibration (--calibrate): " + start + (start.empty() ? "" : " ") + describe(trial) +
         (trial.worthUsing() ? "" : " The run keeps what was given.");
}

}  // namespace

std::string dumpedConfig(const ReplayArguments& arguments)
{
  Loaded loaded = loadConfiguration(arguments);
  if (!arguments.input_files.empty())
  {
    checked([&] { requireReadableRecordings(arguments.input_files); });
    takePreset(sensorsOf(arguments, loaded.file.config), loaded);
  }
  const std::string file = inOneLine(arguments.parameters.config_file);
  const auto origin = [&](std::string_view view) -> std::string
  {
    const std::string key(view);
    if (const auto found = loaded.origins.find(key); found != loaded.origins.end())
      return found->second;
    if (const auto found = loaded.file.lines.find(key); found != loaded.file.lines.end())
      return file + ", line " + std::to_string(found->second);
    return "default";
  };
  return configDump(loaded.file.config, origin, arguments.dump_config == "main");
}

RunSetup setUpRun(const ReplayArguments& arguments)
{
  RunSetup setup;
  Loaded loaded = loadConfiguration(arguments);
  setup.config = loaded.file.config;
  if (!arguments.parameters.settings.empty()) checked([&] { return validate(setup.config); });
  setup.arguments = withoutDoubleTrajectory(arguments, setup.config);
  setup.outputs =
      failingWith(ExitStatus::Usage, [&] { return planOutputs(setup.arguments, setup.config); });
  checked([&] { requireReadableRecordings(arguments.input_files); });
  requireReference(arguments.reference);
  checked(
      [&]
      {
        requireGivenOnce(arguments.input_files);
        if (!arguments.in_order) requireInOrder(arguments.input_files);
      });
  setup.selection = sensorsOf(arguments, setup.config);
  std::vector<std::string> notes;
  setup.configuration = arguments.parameters.config_file.empty() ? "defaults (no --config given)"
                                                                 : arguments.parameters.config_file;
  if (const auto preset = takePreset(setup.selection, loaded))
  {
    setup.config = loaded.file.config;
    setup.configuration += ", with the preset " + preset->name;
    notes.push_back(preset->text);
  }
  if (arguments.calibrate)
    notes.push_back(checked([&] { return calibrateFirst(arguments.input_files, setup.config); }));
  setup.plan = checked(
      [&]
      { return planInput(setup.selection, setup.config.sensors, setup.config.odometry.lidar); });
  setup.plan.notes.insert(setup.plan.notes.end(), notes.begin(), notes.end());
  setup.frame = outputFrameOf(arguments.frame, setup.plan.T_vehicle_imu);
  setup.saved_map = savedMapOf(arguments, setup.frame);
  return setup;
}

}  // namespace fastlio
