// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_places.h"

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/same_file.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kTrajectory = "trajectory.tum";
constexpr const char* kReport = "report.html";

std::vector<std::string> namesInFolder(const ReplayArguments& arguments, const Config& config)
{
  ExportTarget target;
  target.directory = arguments.output_directory;
  target.parameters = config.exporters;
  target.imu_rate = config.odometry.imu_rate;
  return outputFileNames(target);
}

std::vector<FileUse> inputsOf(const ReplayArguments& arguments)
{
  std::vector<FileUse> inputs;
  inputs.reserve(arguments.input_files.size() + 3);
  for (const std::string& file : arguments.input_files)
    inputs.push_back({file, "--input-rawlog"});
  inputs.push_back({arguments.parameters.config_file, "--config"});
  inputs.push_back({arguments.map_in, "--map-in"});
  inputs.push_back({referenceFor(arguments.reference, arguments.input_files), "--reference"});
  return inputs;
}

std::vector<FileUse> outputsOf(
    const ReplayArguments& arguments, const std::vector<std::string>& names)
{
  std::vector<FileUse> outputs;
  outputs.reserve(names.size() + 1);
  for (const std::string& name : names)
    outputs.push_back({(fs::path(arguments.output_directory) / name).string(), "--output-dir"});
  outputs.push_back({arguments.output_tum_path, "--output-tum-path"});
  return outputs;
}

/** The folders where a recording may keep clouds in files of their own, by MRPT's names. */
std::vector<std::string> externalFolders(const std::string& rawlog)
{
  const fs::path folder = fs::path(rawlog).parent_path();
  const std::string stem = fs::path(rawlog).stem().string();
  return {
      (folder / (stem + "_Images")).string(), (folder / (stem + "_images")).string(),
      (folder / "Images").string()};
}

void requireOutsideOfRecordings(
    const ReplayArguments& arguments, const std::vector<FileUse>& outputs)
{
  for (const std::string& rawlog : arguments.input_files)
    for (const std::string& folder : externalFolders(rawlog))
      for (const FileUse& output : outputs)
        if (isBelow(output.path, folder))
          throw std::invalid_argument(
              "the output '" + output.path + "' (" + output.role + ") lies in '" + folder +
              "', which belongs to the recording '" + rawlog + "'; choose another place");
}

/** Only the report compares with a reference. */
void requireReport(const ReplayArguments& arguments, const std::vector<std::string>& names)
{
  if (arguments.reference.empty() || std::count(names.begin(), names.end(), kReport) > 0) return;
  throw std::invalid_argument(
      std::string("--reference is compared with in ") + kReport +
      ", which is not among the outputs: name it with --export (report), or leave --reference out");
}

std::string tumFolder(const std::string& path)
{
  if (fs::is_directory(path))
    throw std::runtime_error("--output-tum-path '" + path + "' is a folder; give a file name");
  // An existing file is replaced where it is, a device is written to.
  const fs::path folder = fs::absolute(withLinksFollowed(path)).parent_path();
  if (!fs::exists(path)) requireWritableFolder(folder.string());
  return folder.string();
}
}  // namespace

OutputPlan planOutputs(const ReplayArguments& arguments, const Config& config)
{
  OutputPlan plan;
  const std::vector<FileUse> inputs = inputsOf(arguments);
  plan.inputs.reserve(inputs.size());
  for (const FileUse& input : inputs)
    plan.inputs.push_back(input.path);
  const std::vector<std::string> names = namesInFolder(arguments, config);
  const std::vector<FileUse> outputs = outputsOf(arguments, names);
  requireDistinctFiles({}, {{arguments.output_directory, "--output-dir"}});
  requireDistinctFiles(inputs, outputs);
  requireOutsideOfRecordings(arguments, outputs);
  requireReport(arguments, names);
  if (!arguments.output_directory.empty())
  {
    plan.folder = RunFolderPlan{
        arguments.output_directory, names,           kSummaryFile, kSummaryKey, arguments.overwrite,
        "fastlio-replay",           isOutputFileName};
    requireReplaceable(*plan.folder);
  }
  if (!arguments.output_tum_path.empty()) plan.tum_folder = tumFolder(arguments.output_tum_path);
  return plan;
}

ReplayArguments withoutDoubleTrajectory(ReplayArguments arguments, const Config& config)
{
  if (arguments.output_directory.empty() || arguments.output_tum_path.empty()) return arguments;
  const std::vector<std::string> names = namesInFolder(arguments, config);
  if (std::find(names.begin(), names.end(), kTrajectory) == names.end()) return arguments;
  const auto own = fs::weakly_canonical(fs::path(arguments.output_directory) / kTrajectory);
  if (fs::weakly_canonical(arguments.output_tum_path) == own) arguments.output_tum_path.clear();
  return arguments;
}

OutputPlaces::OutputPlaces(OutputPlan plan) : plan_(std::move(plan))
{
  if (plan_.folder) folder_.emplace(*plan_.folder);
  if (!plan_.tum_folder.empty()) tum_folder_ = MadeFolders(plan_.tum_folder);
}

void OutputPlaces::removeLeftovers(const RunSummary& summary) const
{
  if (!folder_ || !summary.output_problems.empty()) return;
  std::vector<std::string> kept = plan_.inputs;
  for (const OutputFile& file : summary.outputs)
    kept.push_back(file.path);
  folder_->removeLeftovers(kept);
}

}  // namespace fastlio
