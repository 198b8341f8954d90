// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-tune: parameters that make the error on recordings smaller. */

#include "../shared/interruption.h"
#include "command_line.h"
#include "job_scripts.h"
#include "tuning_run.h"
#include <fastlio/files/failure_text.h>

#include <iostream>
#include <stdexcept>

namespace
{
using fastlio::Conclusion;
using fastlio::TuneCommand;
constexpr int kExitInput = 1;
constexpr int kExitKeep = 2;
constexpr int kExitWorse = 3;
constexpr int kExitInterrupted = 130;

void printStatus(const TuneCommand& command)
{
  std::cout << "search version open running finished failed started\n";
  for (const auto& row : fastlio::JobStore(command.runner.store).counts())
    std::cout << row.search << ' ' << row.version << ' ' << row.open << ' ' << row.running << ' '
              << row.finished << ' ' << row.failed << ' ' << row.started << '\n';
}

int run(const TuneCommand& command)
{
  using Task = TuneCommand::Task;
  switch (command.task)
  {
    case Task::Rank:
      fastlio::rankProxy(command);
      return 0;
    case Task::Work:
      fastlio::runAny(command.runner);
      return 0;
    case Task::Status:
      printStatus(command);
      return 0;
    case Task::PrintSlurm:
    case Task::PrintParallel:
      fastlio::printScript(command);
      return 0;
    default:
      break;
  }
  const Conclusion conclusion = fastlio::tune(command);
  if (conclusion == Conclusion::WorseOnLeftOut) return kExitWorse;
  return conclusion == Conclusion::Better ? 0 : kExitKeep;
}
}  // namespace

int main(int argc, char** argv)
try
{
  const auto parsed = fastlio::parseCommandLine(argc, argv);
  if (const int* status = std::get_if<int>(&parsed)) return *status;
  fastlio::catchInterruptions();
  const int status = run(std::get<TuneCommand>(parsed));
  std::cout.flush();
  if (!std::cout) throw std::runtime_error("standard output cannot be written");
  return status;
}
catch (const fastlio::Interrupted&)
{
  std::cerr << "fastlio-tune: interrupted; finished runs are kept, the same command goes on\n";
  return kExitInterrupted;
}
catch (const std::exception& e)
{
  std::cerr << "fastlio-tune: " << fastlio::failureText(e) << '\n';
  return kExitInput;
}
