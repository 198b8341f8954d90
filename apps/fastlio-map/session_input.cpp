// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "session_input.h"

#include "../shared/readable_recordings.h"
#include "../shared/run_names.h"
#include <fastlio/config/config_yaml.h>
#include <fastlio/files/same_file.h>
#include <fastlio/rawlog/recording_formats.h>
#include <fastlio/run/run_folder.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
using Json = nlohmann::json;

/** Where the recording of a run is now: as its record has it, or beside its folder. */
std::string locate(const std::string& recorded, const fs::path& folder)
{
  const fs::path path(recorded);
  const fs::path parent = fs::absolute(folder).parent_path();
  for (const fs::path& place : {path, parent / path, parent / path.filename()})
  {
    std::error_code ignored;
    if (fs::exists(place, ignored)) return place.string();
  }
  throw std::runtime_error(
      "the recording '" + recorded + "' of the run '" + folder.string() +
      "' is not there any more; give the recording itself");
}

RunInput inputOfFolder(const std::string& folder)
{
  const fs::path record = fs::path(folder) / kSummaryFile;
  std::ifstream file(record);
  if (!file)
    throw std::runtime_error(
        "the folder '" + folder + "' has no " + kSummaryFile +
        ": it is none that fastlio-replay has written, and no recording");
  const Json json = Json::parse(file, nullptr, false);
  if (json.is_object() && json.value("program", "") == "fastlio-map")
    throw std::runtime_error(
        "'" + folder +
        "' is a folder of fastlio-map, which cannot be mapped again; give the recordings, or the "
        "folders of runs of fastlio-replay");
  RunInput input;
  try
  {
    for (const Json& recorded : json.at("input").at("files"))
      input.files.push_back(locate(recorded.at("path").get<std::string>(), folder));
    // JSON is YAML, too.
    input.parameters =
        loadConfig(mrpt::containers::yaml::FromText(json.at("parameters").dump()), record.string());
  }
  catch (const Json::exception&)
  {
    throw std::runtime_error(
        "'" + record.string() +
        "' is not the summary of a run of fastlio-replay, or damaged: it does not hold the "
        "recording and the parameters; give the recording itself");
  }
  if (input.files.empty()) throw std::runtime_error("'" + record.string() + "' names no recording");
  input.name = recordingName(folder);
  return input;
}

bool isRunFolder(const std::string& path)
{
  std::error_code ignored;
  return fs::is_directory(path, ignored) && recordingFormatOf(path) == nullptr;
}

/** The recordings that are named themselves, not by the folder of a run. */
std::vector<RecordingParts> recordingsOf(const MapArguments& arguments)
{
  std::vector<std::string> files;
  std::copy_if(
      arguments.runs.begin(), arguments.runs.end(), std::back_inserter(files),
      [](const std::string& run) { return !isRunFolder(run); });
  if (files.empty()) return {};
  requireGivenOnce(files);
  return partsOf(files, arguments.joining);
}

void makeNamesUnique(std::vector<RunInput>& inputs)
{
  std::set<std::string> taken;
  for (RunInput& input : inputs)
    input.name = firstFree(
        input.name, [&taken](const std::string& name) { return !taken.insert(name).second; });
}
}  // namespace

std::vector<RunInput> runInputs(const MapArguments& arguments)
{
  std::vector<RunInput> inputs;
  const std::vector<RecordingParts> recordings = recordingsOf(arguments);
  auto recording = recordings.begin();
  for (const std::string& run : arguments.runs)
  {
    if (isRunFolder(run))
    {
      inputs.push_back(inputOfFolder(run));
      continue;
    }
    // Further parts have come with the first one.
    if (recording == recordings.end() || recording->files.front() != run) continue;
    inputs.push_back({recordingName(run), recording->files, std::nullopt, describe(*recording)});
    ++recording;
  }
  std::vector<std::string> all;
  for (const RunInput& input : inputs)
  {
    requireReadableRecordings(input.files);
    all.insert(all.end(), input.files.begin(), input.files.end());
  }
  requireDifferentRecordings(all);
  makeNamesUnique(inputs);
  return inputs;
}

std::vector<Session> openSessions(
    const MapArguments& arguments, const std::vector<RunInput>& inputs)
{
  std::vector<Session> sessions;
  for (const RunInput& input : inputs)
  {
    ConfigFile given = givenParameters(arguments.parameters, input.parameters.value_or(Config{}));
    given.config.odometry.threads = arguments.threads;
    // The parameters of a run hold the values of the preset already.
    const bool all_given = input.parameters && arguments.parameters.config_file.empty();
    sessions.emplace_back(
        input.name, input.files, given.config,
        [&](std::string_view key) { return all_given || given.lines.count(std::string(key)) > 0; });
  }
  return sessions;
}

}  // namespace fastlio
