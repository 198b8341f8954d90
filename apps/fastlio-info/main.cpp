// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-info: what is in a recording, and what would fastlio-replay do with it?
 */

#include "../shared/failure.h"
#include "command_line.h"
#include "config_proposal.h"
#include "info_report.h"
#include <fastlio/config/config_yaml.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/same_file.h>
#include <fastlio/survey/recording_parts.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <unistd.h>

namespace
{
using namespace fastlio;

/** On a terminal only: the table may be redirected, the progress goes to standard error. */
SurveyOptions optionsOf(const InfoArguments& arguments)
{
  SurveyOptions options;
  options.check_motion = arguments.check_motion;
  if (arguments.quiet || isatty(STDERR_FILENO) == 0) return options;
  options.progress = [last = -1](double fraction) mutable
  {
    const int percent = static_cast<int>(100.0 * fraction);
    if (percent == last) return;
    last = percent;
    std::cerr << "\rreading " << percent << " %  " << (fraction >= 1.0 ? "\r             \r" : "")
              << std::flush;
  };
  return options;
}

void write(const InfoArguments& arguments, const RecordingSurvey& survey)
{
  const bool json_to_stdout = arguments.json_path == "-";
  if (json_to_stdout)
    std::cout << toJson(survey) << std::flush;
  else if (!arguments.quiet)
    std::cout << toTable(survey) << std::flush;
  if (!std::cout) throw std::runtime_error("standard output cannot be written");
  if (!arguments.json_path.empty() && !json_to_stdout)
    writeFileAtomically(arguments.json_path, toJson(survey));
}

/** Nothing may replace what it is about, nor parameters that somebody has edited. */
void requireHarmlessOutput(const InfoArguments& arguments)
{
  if (!arguments.new_config.empty() && std::filesystem::exists(arguments.new_config))
    throw std::invalid_argument(
        "--write-config: '" + arguments.new_config +
        "' is there already; give another name, or remove it");
  std::vector<FileUse> inputs, outputs;
  if (!arguments.new_config.empty()) outputs.push_back({arguments.new_config, "--write-config"});
  if (!arguments.json_path.empty() && arguments.json_path != "-")
    outputs.push_back({arguments.json_path, "--json"});
  for (const std::string& file : arguments.input_files)
    inputs.push_back({file, "recording"});
  if (!arguments.config_file.empty()) inputs.push_back({arguments.config_file, "--config"});
  requireDistinctFiles(inputs, outputs);
}

InfoStatus run(const InfoArguments& arguments)
{
  requireGivenOnce(arguments.input_files);
  requireInOrder(arguments.input_files);
  requireHarmlessOutput(arguments);
  Config config;
  if (!arguments.config_file.empty()) config = loadConfigFromFile(arguments.config_file);
  for (const std::string& setting : arguments.settings)
    applySetting(setting, config);
  validate(config);
  const RecordingSurvey survey =
      surveyRecording(arguments.input_files, config.sensors, config.odometry, optionsOf(arguments));
  write(arguments, survey);
  if (!arguments.new_config.empty() && survey.unusable.empty())
    writeFileAtomically(arguments.new_config, proposedConfig(survey, config));
  return survey.unusable.empty() ? InfoStatus::Ok : InfoStatus::Unusable;
}
}  // namespace

int main(int argc, char** argv)
{
  const auto parsed = parseCommandLine(argc, argv);
  if (const auto* status = std::get_if<int>(&parsed)) return *status;
  return endOf(
      "fastlio-info", InfoStatus::Usage, [&] { return run(std::get<InfoArguments>(parsed)); });
}
