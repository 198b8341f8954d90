// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-replay: a recording in, trajectory and map out. */

#include "../shared/failure.h"
#include "../shared/interruption.h"
#include "../shared/run_names.h"
#include "batch.h"
#include "command_line.h"
#include "replay_run.h"
#include "run_report.h"
#include "run_setup.h"
#include <fastlio/files/failure_text.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>

namespace
{
using namespace fastlio;

ExitStatus report(const RunSummary& summary, mrpt::system::COutputLogger& logger)
{
  const ExitStatus status = exitStatusOf(summary);
  const auto level = status == ExitStatus::Ok ? mrpt::system::LVL_WARN : mrpt::system::LVL_ERROR;
  for (const auto& sentence : troubleSentences(summary))
    logger.logStr(level, sentence);
  if (logger.getMinLoggingLevel() <= mrpt::system::LVL_WARN) std::cout << reportText(summary);
  return status;
}

/** Once the run has begun, nothing is blamed on the command line any more. */
ExitStatus execute(ReplayRun& run, mrpt::system::COutputLogger& logger)
{
  try
  {
    return report(run.execute(), logger);
  }
  catch (const std::exception& e)
  {
    throw Failure(ExitStatus::OutputFailed, "the run could not be completed: " + failureText(e));
  }
}

ExitStatus replay(const ReplayArguments& arguments, mrpt::system::COutputLogger& logger)
{
  if (!arguments.dump_config.empty())
  {
    std::cout << dumpedConfig(arguments) << std::flush;
    if (!std::cout) throw Failure(ExitStatus::OutputFailed, "standard output cannot be written");
    return ExitStatus::Ok;
  }
  RunSetup setup = setUpRun(arguments);
  std::istringstream sensors(describe(setup.selection));
  for (std::string line; std::getline(sensors, line);)
    logger.logStr(mrpt::system::LVL_INFO, line);
  for (const auto& note : setup.plan.notes)
    logger.logStr(mrpt::system::LVL_INFO, note);
  for (const auto& warning : setup.plan.warnings)
    logger.logStr(mrpt::system::LVL_WARN, warning);
  logger.logStr(mrpt::system::LVL_INFO, "parameters: " + setup.configuration);
  catchInterruptions();
  ReplayRun run(std::move(setup), logger);
  return execute(run, logger);
}

/** A run without outputs gets a folder of its own. */
ExitStatus runNamed(ReplayArguments& arguments, mrpt::system::COutputLogger& logger)
{
  const bool own_folder = arguments.dump_config.empty() && arguments.output_directory.empty() &&
                          arguments.output_tum_path.empty();
  if (own_folder) arguments.output_directory = freeRunFolder(arguments.input_files.front());
  const ExitStatus status = replay(arguments, logger);
  if (!own_folder || !std::filesystem::is_directory(arguments.output_directory)) return status;
  if (const auto problem = linkLatest(arguments.output_directory))
    logger.logStr(mrpt::system::LVL_WARN, *problem);
  return status;
}

ExitStatus logged(BatchRun& run)
{
  ReplayArguments& arguments = run.arguments;
  mrpt::system::COutputLogger logger("fastlio-replay");
  logger.setMinLoggingLevel(arguments.verbosity);
  if (!run.note.empty()) logger.logStr(mrpt::system::LVL_INFO, run.note);
  try
  {
    return failingWith(ExitStatus::Usage, [&] { return runNamed(arguments, logger); });
  }
  catch (const Failure& e)
  {
    logger.logStr(mrpt::system::LVL_ERROR, e.what());
    return static_cast<ExitStatus>(e.status());
  }
}

/** One run, or one for each recording. */
ExitStatus all(const ReplayArguments& arguments)
{
  std::vector<BatchRun> runs = runsOf(arguments);
  ExitStatus worst = ExitStatus::Ok;
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    runs[i].status = logged(runs[i]);
    worst = graver(worst, runs[i].status);
    if (worst == ExitStatus::Interrupted) runs.resize(i + 1);
  }
  if (runs.front().arguments.batch && !arguments.quiet) std::cout << batchTable(runs);
  return worst;
}
}  // namespace

int main(int argc, char** argv)
try
{
  const auto parsed = parseCommandLine(argc, argv);
  if (const auto* status = std::get_if<int>(&parsed)) return *status;
  return static_cast<int>(all(std::get<ReplayArguments>(parsed)));
}
catch (const std::bad_alloc&)
{
  std::fputs("fastlio-replay: there is not enough memory\n", stderr);  // needs none itself
  return static_cast<int>(ExitStatus::Usage);
}
catch (const std::exception& e)
{
  std::cerr << "fastlio-replay: " << e.what() << '\n';
  return static_cast<int>(ExitStatus::Usage);
}
