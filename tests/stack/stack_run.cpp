// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "stack_run.h"

#include <fastlio/simulation/recording.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace fastlio::testing
{
namespace
{
SimulationSettings settings()
{
  SimulationSettings s = defaultSettings("office");
  s.duration = 26.0;
  return s;
}
}  // namespace

std::optional<std::string> findProgram(const std::string& name)
{
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    const auto candidate = std::filesystem::path(folder) / name;
    if (access(candidate.c_str(), X_OK) == 0) return candidate.string();
  }
  return std::nullopt;
}

const StackRun& StackRun::get()
{
  static const StackRun run;
  return run;
}

StackRun::StackRun()
    : folder_(
          std::filesystem::temp_directory_path() / ("fastlio-stack-" + std::to_string(getpid()))),
      simulation_(settings())
{
  std::filesystem::create_directories(folder_);
  writeRecording(simulation_, folder_.string());
  replay("observations", "trajectory,simplemap,rawlog,graph,g2o,metricmap");
  replay("actions", "rawlog");
}

StackRun::~StackRun()
{
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void StackRun::replay(const std::string& form, const std::string& exporters) const
{
  std::ifstream matching(file("config.yaml"));
  std::ostringstream config;
  config << matching.rdbuf();
  const std::string text = config.str() + "\noutput: {rawlog_form: " + form + "}\n";
  std::ofstream(file(form + ".yaml")) << text;
  const auto result =
      Process(
          {FASTLIO_REPLAY_PROGRAM, "-c", file(form + ".yaml"), "--input-rawlog",
           file("recording.rawlog"), "--output-dir", file(form), "--export", exporters},
          file("replay.log"))
          .wait();
  if (result.exit_status != 0) throw std::runtime_error("fastlio-replay: " + result.output);
}

ProcessResult StackTest::run(
    const std::string& program, const std::vector<std::string>& arguments,
    const std::vector<std::string>& variables) const
{
  std::vector<std::string> command = {"/usr/bin/env"};
  command.insert(command.end(), variables.begin(), variables.end());
  command.push_back(findProgram(program).value_or(program));
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Process(command, file("program.log")).wait();
}

std::string StackTest::write(const std::string& name, const std::string& content) const
{
  std::ofstream(file(name)) << content;
  return file(name);
}

}  // namespace fastlio::testing
