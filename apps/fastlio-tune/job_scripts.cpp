// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "job_scripts.h"

#include "trials.h"
#include <fastlio/options/number_text.h>

#include <filesystem>
#include <iostream>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

std::string quoted(const std::string& text)
{
  std::string result = "'";
  for (const char c : text)
    if (c == '\'')
      result += "'\\''";
    else
      result += c;
  return result + "'";
}

std::string workerCommand(const TuneCommand& command)
{
  return quoted(fs::read_symlink("/proc/self/exe").string()) + " --work " +
         quoted(fs::absolute(command.runner.store).string()) + " --timeout " +
         shortestText(command.runner.timeout) + " --wait " + shortestText(command.runner.wait);
}
}  // namespace

std::string slurmScript(const TuneCommand& command)
{
  return "#!/bin/sh\n"
         "#SBATCH --job-name=fastlio-tune\n"
         "#SBATCH --array=1-" +
         std::to_string(command.workers) +
         "\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n#SBATCH --requeue\n"
         "#SBATCH --output=" +
         quoted(fs::absolute(command.runner.store).string() + ".%A_%a.log") + "\nexec " +
         workerCommand(command) + "\n";
}

std::string workerCommands(const TuneCommand& command)
{
  std::string text;
  for (int i = 0; i < command.workers; ++i)
    text += workerCommand(command) + "\n";
  return text;
}

void printScript(const TuneCommand& command)
{
  const SearchInputs inputs = readInputs(command);
  Evaluator evaluator(command, inputs);
  evaluator.add(knownSets(command, inputs), allRecordings(inputs));
  std::cout
      << (command.task == TuneCommand::Task::PrintSlurm ? slurmScript(command)
                                                        : workerCommands(command));
  if (command.quiet) return;
  std::cerr
      << (command.search.method == "cmaes"
              ? "fastlio-tune: cmaes makes jobs as results come: keep the same command running "
                "with -j 0 instead of the --print option, and give workers a --wait\n"
              : "fastlio-tune: when the workers are done, the same command without the "
                "--print option prints the result\n");
}
}  // namespace fastlio
