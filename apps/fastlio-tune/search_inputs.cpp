// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "search_inputs.h"

#include <fastlio/config/config_document.h>
#include <fastlio/config/config_yaml.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/input_file.h>
#include <fastlio/files/same_file.h>
#include <fastlio/options/printable.h>
#include <fastlio/rawlog/recording_formats.h>

#include <algorithm>
#include <array>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

void requireReadable(const std::string& file, const std::string& role)
{
  // Some recordings are folders.
  if (const auto problem = role == "recording" ? recordingProblem(file) : inputFileProblem(file))
    throw std::invalid_argument(role + " '" + printable(file) + "' " + *problem);
}

/** Recordings are easily given first. */
void requireSpaceOfText(const std::string& file)
{
  requireReadable(file, "search space");
  std::array<char, 4096> bytes{};
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), bytes.size());
  const auto is_control = [](char c) { return c >= 0 && c < '\t'; };
  if (std::none_of(bytes.begin(), bytes.begin() + in.gcount(), is_control)) return;
  throw std::invalid_argument(
      "search space '" + printable(file) +
      "' is not a text file; give the search space first, then the recordings: "
      "fastlio-tune SPACE.yaml RECORDING...");
}

/** The given truth, or the file beside the recording when it is there. */
std::string truthOf(const TuneFiles& files, std::size_t i)
{
  if (!files.truths.empty())
  {
    requireReadable(files.truths[i], "--truth");
    return fs::canonical(files.truths[i]).string();
  }
  const std::string beside = referenceFor("", {files.recordings[i]});
  return beside.empty() ? beside : fs::canonical(beside).string();
}

std::vector<RecordingInput> recordingsOf(const TuneFiles& files)
{
  if (!files.truths.empty() && files.truths.size() != files.recordings.size())
    throw std::invalid_argument(
        "--truth is given " + std::to_string(files.truths.size()) + " times for " +
        std::to_string(files.recordings.size()) + " recordings; give one for each, in their order");
  requireDifferentRecordings(files.recordings);
  std::vector<RecordingInput> recordings;
  for (std::size_t i = 0; i < files.recordings.size(); ++i)
  {
    requireReadable(files.recordings[i], "recording");
    recordings.push_back({fs::canonical(files.recordings[i]).string(), truthOf(files, i)});
  }
  return recordings;
}

std::string measureOf(const TuneCommand& command, const std::vector<RecordingInput>& recordings)
{
  const auto without = std::find_if(
      recordings.begin(), recordings.end(), [](const auto& r) { return r.truth.empty(); });
  const bool needed = command.task == TuneCommand::Task::Rank || command.measure == "ape" ||
                      command.measure == "rpe";
  const bool none = std::all_of(
      recordings.begin(), recordings.end(), [](const auto& r) { return r.truth.empty(); });
  if (without != recordings.end() && (needed || (command.measure == "auto" && !none)))
    throw std::invalid_argument(
        "recording '" + printable(without->path) +
        "' has no ground truth: put NAME.gt.tum beside NAME.rawlog, name it with --truth, or "
        "choose "
        "--measure proxy");
  if (command.measure != "auto") return command.measure;
  return none ? "proxy" : "ape";
}

std::string contentOf(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/** Size and time of change of a file, or of all files of a folder. */
std::string stateOf(const std::string& path)
{
  const auto state = [](const fs::path& file)
  {
    return std::to_string(fs::file_size(file)) + " " +
           std::to_string(fs::last_write_time(file).time_since_epoch().count()) + "\n";
  };
  if (path.empty()) return "\n";
  if (!fs::is_directory(path)) return state(path);
  std::vector<std::string> states;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file())
      states.push_back(entry.path().string() + " " + state(entry.path()));
  std::sort(states.begin(), states.end());
  std::string text;
  for (const std::string& one : states)
    text += one;
  return text;
}

/** Each part with its length, so that no two inputs make one text. */
std::string digestOf(const std::vector<std::string>& parts)
{
  std::string text;
  for (const std::string& part : parts)
    text += std::to_string(part.size()) + ":" + part;
  return to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(text));
}

std::string idOf(const TuneCommand& command, const SearchInputs& inputs)
{
  std::vector<std::string> parts = {
      programVersion(), command.search.method,          std::to_string(command.search.seed),
      command.frame,    contentOf(command.files.space), baseYaml(inputs)};
  // CMA-ES follows the measure.
  if (command.search.method == "cmaes") parts.push_back(inputs.measure);
  for (const RecordingInput& recording : inputs.recordings)
    for (const std::string& file : {recording.path, recording.truth})
      parts.push_back(file), parts.push_back(stateOf(file));
  return digestOf(parts);
}

void requireHarmlessOutputs(const TuneCommand& command, const SearchInputs& inputs)
{
  std::vector<FileUse> read = {
      {command.files.space, "search space"}, {command.files.base, "--config"}};
  for (const RecordingInput& recording : inputs.recordings)
  {
    read.push_back({recording.path, "recording"});
    read.push_back({recording.truth, "--truth"});
  }
  requireDistinctFiles(
      read, {{command.files.output, "--output"},
             {command.files.report, "--report"},
             {command.runner.store, "--store"},
             {command.files.json, "--json"}});
}
}  // namespace

SearchInputs readInputs(const TuneCommand& command)
{
  requireSpaceOfText(command.files.space);
  SearchInputs inputs;
  inputs.space = readSearchSpace(command.files.space);
  if (!command.files.base.empty())
  {
    const ConfigFile file = readConfigFile(command.files.base);
    inputs.base = file.config;
    for (const auto& [key, line] : file.lines)
      inputs.base_keys.insert(key);
  }
  inputs.recordings = recordingsOf(command.files);
  inputs.measure = measureOf(command, inputs.recordings);
  requireHarmlessOutputs(command, inputs);
  inputs.id = idOf(command, inputs);
  return inputs;
}

std::string baseYaml(const SearchInputs& inputs)
{
  return toYaml(inputs.base, [&](std::string_view key) { return inputs.base_keys.count(key) > 0; });
}

std::string searchedYaml(const SearchInputs& inputs, const Config& config)
{
  const auto given = [&](std::string_view key)
  {
    return inputs.base_keys.count(key) > 0 ||
           std::any_of(
               inputs.space.begin(), inputs.space.end(),
               [&](const SearchKey& searched) { return searched.key == key; });
  };
  return toYaml(config, given);
}

std::string nameWithUnit(const std::string& measure)
{
  if (measure == "ape") return "ape [m]";
  return measure == "rpe" ? "rpe [m/s]" : measure;
}
}  // namespace fastlio
