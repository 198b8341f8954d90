// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-info: what is in a recording, and what would fastlio-replay do with it?
 */

#include "../shared/failure.h"
#include "../shared/terminal_line.h"
#include "command_line.h"
#include "config_proposal.h"
#include "info_report.h"
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/same_file.h>
#include <fastlio/survey/recording_parts.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace
{
using namespace fastlio;

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
  outputs.push_back({arguments.new_config, "--write-config"});
  if (arguments.json_path != "-") outputs.push_back({arguments.json_path, "--json"});
  for (const std::string& file : arguments.input_files)
    inputs.push_back({file, "recording"});
  inputs.push_back({arguments.parameters.config_file, "--config"});
  requireDistinctFiles(inputs, outputs);
}

InfoStatus run(const InfoArguments& arguments)
{
  requireGivenOnce(arguments.input_files);
  requireInOrder(arguments.input_files);
  requireHarmlessOutput(arguments);
  const Config config = givenParameters(arguments.parameters).config;
  TerminalLine line(!arguments.quiet);
  SurveyOptions options;
  options.check_motion = arguments.check_motion;
  options.progress = [&line](double share) { line.showShare("reading", share); };
  const RecordingSurvey survey =
      surveyRecording(arguments.input_files, config.sensors, config.odometry, options);
  line.clear();
  write(arguments, survey);
  if (!arguments.new_config.empty() && survey.unusable.empty())
    writeFileAtomically(arguments.new_config, proposedConfig(survey, config));
  return survey.unusable.empty() ? InfoStatus::Ok : InfoStatus::Unusable;
}
}  // namespace

int main(int argc, char** argv)
{
  return endOf("fastlio-info", InfoStatus::Usage, parseCommandLine(argc, argv), run);
}
