// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-sim: simulated recordings with exact ground truth. */

#include "../shared/failure.h"
#include "../shared/parsing.h"
#include "command_line.h"
#include <fastlio/simulation/recording.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <unistd.h>

namespace
{
constexpr int kExitOk = 0;
constexpr int kExitError = 1;

/** A line that is overwritten, on terminals only. */
void showProgress(std::size_t done, std::size_t total)
{
  std::cerr << "\r  " << done << " / " << total << " sweeps" << (done == total ? "\n" : "")
            << std::flush;
}

void simulate(const fastlio::SimCommand& command)
{
  const auto begin = std::chrono::steady_clock::now();
  const std::string directory =
      command.output_dir.empty() ? "simulated_" + command.scenario : command.output_dir;
  fastlio::requireRecordingPlace(directory, command.overwrite);
  const fastlio::Simulation simulation(fastlio::settingsOf(command));
  const bool progress = !command.quiet && isatty(STDERR_FILENO) == 1;
  const fastlio::RecordingFiles files = fastlio::writeRecording(
      simulation, directory, progress ? showProgress : fastlio::RecordingProgress{},
      command.overwrite);
  if (command.quiet) return;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::cout << "Simulated '" << command.scenario << "': " << simulation.settings().duration
            << " s, " << simulation.scanCount() << " sweeps, " << simulation.imu().samples.size()
            << " IMU samples, in " << took.count() << " s.\n";
  for (const auto& file : {files.rawlog, files.ground_truth, files.config, files.scenario})
    std::cout << "  " << file << '\n';
}

void run(const fastlio::SimCommand& command)
{
  if (command.list_scenarios)
  {
    std::cout << fastlio::scenarioList();
    return;
  }
  if (command.scenario.empty())
    throw std::invalid_argument(
        "No scenario given. Choose one with --scenario NAME:\n" + fastlio::scenarioList());
  if (command.list_settings)
    std::cout << fastlio::settingsList(fastlio::settingsOf(command));
  else
    simulate(command);
}
}  // namespace

int main(int argc, char** argv)
{
  return fastlio::endOf(
      "fastlio-sim", kExitError,
      [&]
      {
        CLI::App app{
            "Makes simulated LiDAR-inertial recordings with exact ground truth.", "fastlio-sim"};
        fastlio::SimCommand command;
        fastlio::addOptions(app, command);
        const auto end = fastlio::endAfterParsing(app, argc, argv, kExitError, [] {});
        if (!end) run(command);
        return end.value_or(kExitOk);
      });
}
