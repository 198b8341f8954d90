// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_setup.h"

#include <fastlio/files/atomic_file.h>
#include <fastlio/math/angles.h>
#include <fastlio/odometry/parameter_yaml.h>
#include <fastlio/rawlog/saved_map_file.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/survey/sensor_selection.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& names)
{
  std::string list;
  for (const auto& name : names)
    list += (list.empty() ? "" : ",") + name;
  return list;
}

/** Whether a list of names, separated by commas, has this one. */
bool names(const std::string& list, const std::string& name)
{
  return std::regex_search(list, std::regex("(^|[, \t])" + name + "([, \t]|$)"));
}

Parameters loadConfiguration(const ReplayArguments& arguments)
{
  Parameters parameters;
  try
  {
    if (!arguments.config_file.empty()) parameters = loadParametersFromFile(arguments.config_file);
  }
  catch (const std::exception& e)
  {
    throw SetupError(ExitStatus::Usage, e.what());
  }
  if (arguments.threads) parameters.threads = *arguments.threads;
  if (arguments.no_map_update) parameters.map.update = false;
  ExportOptions& output = parameters.output;
  if (!arguments.exporters.empty()) output.exporters = joined(arguments.exporters);
  if (arguments.imu_rate || names(output.exporters, "imu_rate")) output.imu_rate = true;
  auto& input = parameters.input;
  input.lidar_sensor_label = arguments.lidar_sensor_label.value_or(input.lidar_sensor_label);
  input.imu_sensor_label = arguments.imu_sensor_label.value_or(input.imu_sensor_label);
  return parameters;
}

/** The trajectory file is not written twice under the same name. */
ReplayArguments withoutDoubleTrajectory(ReplayArguments arguments)
{
  if (arguments.output_directory.empty() || arguments.output_tum_path.empty()) return arguments;
  const auto own = fs::weakly_canonical(fs::path(arguments.output_directory) / "trajectory.tum");
  if (fs::weakly_canonical(arguments.output_tum_path) == own) arguments.output_tum_path.clear();
  return arguments;
}

void prepareOutputs(const ReplayArguments& arguments)
{
  try
  {
    if (!arguments.output_directory.empty()) prepareOutputDirectory(arguments.output_directory);
    if (arguments.output_tum_path.empty()) return;
    const auto parent = fs::absolute(arguments.output_tum_path).parent_path().string();
    prepareOutputDirectory(parent);
    if (fs::is_directory(arguments.output_tum_path))
      throw std::runtime_error(
          "--output-tum-path '" + arguments.output_tum_path + "' is a folder; give a file name");
  }
  catch (const std::exception& e)
  {
    throw SetupError(ExitStatus::Usage, e.what());
  }
}

void requireReadable(const std::vector<std::string>& files)
{
  for (const auto& file : files)
  {
    if (!fs::exists(file))
      throw SetupError(
          ExitStatus::InputUnusable,
          "input file '" + file + "' does not exist; check the path given to --input-rawlog");
    if (fs::is_directory(file) || !std::ifstream(file, std::ios::binary))
      throw SetupError(
          ExitStatus::InputUnusable,
          "input file '" + file +
              "' cannot be read; --input-rawlog takes a rawlog file that you "
              "may read");
  }
}

/** Runs what may throw std::invalid_argument for a parameter, others for the input. */
template <typename Step>
auto checked(Step step)
{
  try
  {
    return step();
  }
  catch (const std::invalid_argument& e)
  {
    throw SetupError(ExitStatus::Usage, e.what());
  }
  catch (const std::exception& e)
  {
    throw SetupError(ExitStatus::InputUnusable, e.what());
  }
}

/** The pose of the body that is written about, as the user gives it. */
Pose poseOf(const std::vector<double>& numbers)
{
  if (numbers.empty()) return {};
  return toPose(mrpt::poses::CPose3D(
      numbers[0], numbers[1], numbers[2], kRadPerDeg * numbers[3], kRadPerDeg * numbers[4],
      kRadPerDeg * numbers[5]));
}

std::optional<SavedMap> savedMapOf(const ReplayArguments& arguments, const OutputFrame& frame)
{
  if (arguments.map_in.empty()) return std::nullopt;
  try
  {
    SavedMap saved = loadSavedMap(arguments.map_in);
    if (!arguments.initial_pose.empty())
      saved.T_map_imu = poseOf(arguments.initial_pose) * frame.T_imu_body.inverse();
    return saved;
  }
  catch (const std::exception& e)
  {
    throw SetupError(ExitStatus::InputUnusable, e.what());
  }
}

OutputFrame outputFrameOf(
    const std::string& name, const SensorOptions& input, const SensorSelection& selection)
{
  if (name == "imu") return {name, Pose{}};
  const Pose T_vehicle_imu = input.T_vehicle_imu.value_or(selection.imu.T_vehicle_sensor);
  return {name, T_vehicle_imu.inverse()};
}
}  // namespace

RunSetup setUpRun(const ReplayArguments& arguments)
{
  RunSetup setup;
  setup.arguments = withoutDoubleTrajectory(arguments);
  setup.parameters = loadConfiguration(arguments);
  prepareOutputs(setup.arguments);
  requireReadable(arguments.input_files);
  const SensorOptions& input = setup.parameters.input;
  const SensorPatterns patterns = patternsOf(setup.parameters);
  setup.selection = checked(
      [&] { return selectSensors(surveySensors(arguments.input_files, patterns), patterns); });
  setup.plan = checked([&] { return planInput(setup.selection, setup.parameters); });
  setup.configuration =
      arguments.config_file.empty() ? "defaults (no --config given)" : arguments.config_file;
  setup.frame = outputFrameOf(arguments.frame, input, setup.selection);
  setup.saved_map = savedMapOf(arguments, setup.frame);
  return setup;
}

}  // namespace fastlio
