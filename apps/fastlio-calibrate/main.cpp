// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-calibrate: from recordings to the calibration of a rig. */

#include "../shared/failure.h"
#include "../shared/readable_recordings.h"
#include "../shared/terminal_line.h"
#include "command_line.h"
#include <fastlio/calibration/calibration_report.h>
#include <fastlio/config/presets.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/made_folders.h>
#include <fastlio/files/own_file.h>
#include <fastlio/files/same_file.h>
#include <fastlio/options/json_text.h>
#include <fastlio/survey/input_plan.h>
#include <fastlio/survey/sensor_selection.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

namespace
{
using namespace fastlio;

/** Minutes of work must not end at a name that cannot be written. */
void requireWritableFile(const FileUse& output)
{
  namespace fs = std::filesystem;
  if (output.path.empty()) return;
  if (fs::is_directory(output.path))
    throw std::invalid_argument(
        output.role + " '" + output.path + "' is a folder; give the name of a file");
  if (fs::exists(output.path)) return;  // a device needs no folder that can be written
  const fs::path folder = fs::absolute(output.path).parent_path();
  if (!fs::is_directory(folder))
    throw std::invalid_argument(
        output.role + " '" + output.path + "': the folder '" + folder.string() +
        "' does not exist; make it, or give another name");
  requireWritableFolder(folder.string());
}

/** Nothing may replace what it comes from. */
void requireHarmlessOutputs(const CalibrateArguments& arguments)
{
  std::vector<FileUse> inputs, outputs{{arguments.output, "--output"}};
  for (const std::string& file : arguments.recordings)
    inputs.push_back({file, "recording"});
  inputs.push_back({arguments.parameters.config_file, "--config"});
  if (arguments.json != "-") outputs.push_back({arguments.json, "--json"});
  requireDistinctFiles(inputs, outputs);
  for (const FileUse& output : outputs)
    requireWritableFile(output);
  if (!arguments.overwrite)
    requireOwnFile(arguments.output, {"fastlio-calibrate", kCalibrationMark});
}

/** A line for people, where the table goes. */
void say(const CalibrateArguments& arguments, const std::string& line)
{
  if (!arguments.quiet && arguments.json != "-") std::cout << line << '\n';
}

std::vector<CalibrationRecording> recordingsOf(const CalibrateArguments& arguments)
{
  const auto nameOf = [](const std::string& file)
  { return std::filesystem::path(file).filename().string(); };
  std::vector<CalibrationRecording> recordings;
  for (const RecordingParts& parts : partsOf(arguments.recordings, arguments.joining))
  {
    if (!parts.pauses.empty()) say(arguments, describe(parts));
    recordings.push_back({nameOf(parts.files.front()), parts.files});
  }
  return recordings;
}

Json trialJson(const CalibrationTrial& trial)
{
  return {
      {"seconds", trial.seconds},
      {"innovation_before", trial.before.innovation()},
      {"innovation_after", trial.after.innovation()},
      {"map_thickness_before_m", trial.before.mapThickness()},
      {"map_thickness_after_m", trial.after.mapThickness()},
      {"better", trial.better()},
      {"worth_using", trial.worthUsing()}};
}

std::string documentOf(
    const Rig& given, const RigEstimate& estimate, const std::optional<CalibrationTrial>& trial)
{
  Json values;
  for (const CalibrationRow& row : calibrationRows(given, estimate))
    values[row.name] = {
        {"unit", row.unit},
        {"given", row.given},
        {"found", row.found},
        {"std", row.std > 0.0 ? Json(row.std) : Json()},
        {"std_before", row.prior_std},
        {"determined", row.determined()},
        {"advice", row.advice}};
  Json beams = Json::array();
  for (std::size_t i = 0; i < estimate.rig.beams.size() && i < estimate.beam_stds.size(); ++i)
    beams.push_back(
        {{"elevation_rad", estimate.rig.beams[i].elevation},
         {"range_m", estimate.rig.beams[i].range},
         {"range_std_m", estimate.beam_stds[i].range},
         {"elevation_offset_rad", estimate.rig.beams[i].elevation_offset},
         {"elevation_offset_std_rad", estimate.beam_stds[i].elevation}});
  Json document{
      {"passes", estimate.passes},
      {"innovation_scale", estimate.innovation_scale},
      {"rotation_contradiction_rad", estimate.rotation_contradiction},
      {"values", values},
      {"beams", beams}};
  document["trial"] = trial ? trialJson(*trial) : Json();
  return jsonText(document);
}

void write(const std::string& path, const std::string& content)
{
  failingWith(CalibrateStatus::NotWritten, [&] { return writeFileAtomically(path, content); });
}

/** The parameters that are given, beside them those of the LiDAR that the first recording names. */
Config withPreset(
    ConfigFile given, const CalibrationRecording& first, const CalibrateArguments& arguments)
{
  const SensorSelection selection = sensorsIn(first.files, given.config.sensors);
  const auto is_given = [&given](std::string_view key)
  { return given.lines.count(std::string(key)) > 0; };
  const auto use = takePreset(selection, is_given, given.config);
  if (use && !use->keys.empty()) say(arguments, use->text);
  return given.config;
}

CalibrateStatus calibrate(const CalibrateArguments& arguments, ConfigFile given)
{
  requireReadableRecordings(arguments.recordings);
  const std::vector<CalibrationRecording> recordings = recordingsOf(arguments);
  const Config config = withPreset(std::move(given), recordings.front(), arguments);
  TerminalLine line(!arguments.quiet);
  const Calibrator calibrator(
      recordings, config, arguments.passes, [&line](const std::string& what) { line.show(what); });
  const RigEstimate estimate = calibrator.calibrate();
  std::optional<CalibrationTrial> trial;
  if (arguments.trial) trial = calibrator.tryOut();
  line.clear();
  for (const std::string& problem : estimate.problems)
    std::cerr << "fastlio-calibrate: " << problem << " (the rest is used)\n";
  const Config calibrated = calibrator.configWith(estimate);
  write(arguments.output, calibrationYaml(calibrated, calibrator.given(), estimate, trial));
  if (arguments.json == "-")
    std::cout << documentOf(calibrator.given(), estimate, trial) << std::flush;
  else if (!arguments.json.empty())
    write(arguments.json, documentOf(calibrator.given(), estimate, trial));
  if (!std::cout) throw Failure(CalibrateStatus::NotWritten, "standard output cannot be written");
  say(arguments, calibrationTable(calibrator.given(), estimate) + "\n" +
                     (trial ? describe(*trial) + "\n" : std::string()) +
                     "Written: " + arguments.output);
  if (!trial || trial->worthUsing()) return CalibrateStatus::Ok;
  say(arguments, "Do not use " + arguments.output + "; keep the parameters that you had. " +
                     (recordings.size() > 1 ? "Are all recordings of the same rig?"
                                            : "A longer recording, with more turns, may help."));
  return CalibrateStatus::NotBetter;
}

CalibrateStatus run(const CalibrateArguments& arguments)
{
  requireDifferentRecordings(arguments.recordings);
  requireHarmlessOutputs(arguments);
  ConfigFile given = givenParameters(arguments.parameters);
  return failingWith(
      CalibrateStatus::Usage, CalibrateStatus::Unusable,
      [&] { return calibrate(arguments, std::move(given)); });
}
}  // namespace

int main(int argc, char** argv)
{
  return endOf("fastlio-calibrate", CalibrateStatus::Usage, parseCommandLine(argc, argv), run);
}
