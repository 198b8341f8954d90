// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-sim: simulated recordings with exact ground truth. */

#include "../shared/failure.h"
#include "../shared/interruption.h"
#include "../shared/parsing.h"
#include "../shared/terminal_line.h"
#include "command_line.h"
#include <fastlio/simulation/recording.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace
{
constexpr int kExitOk = 0;
constexpr int kExitError = 1;
constexpr int kExitInterrupted = 130;

void simulate(const fastlio::SimCommand& command)
{
  const auto begin = std::chrono::steady_clock::now();
  const std::string directory =
      command.output_dir.empty() ? "simulated_" + command.scenario : command.output_dir;
  fastlio::requireRecordingPlace(directory, command.overwrite);
  const fastlio::Simulation simulation(fastlio::settingsOf(command));
  fastlio::TerminalLine line(!command.quiet);
  const fastlio::RecordingFiles files = fastlio::writeRecording(
      simulation, directory,
      [&line](std::size_t done, std::size_t total)
      {
        if (fastlio::interrupted())
          throw fastlio::Failure(kExitInterrupted, "interrupted; nothing was written");
        line.show(std::to_string(done) + " / " + std::to_string(total) + " sweeps");
      },
      command.overwrite);
  line.clear();
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
  fastlio::catchInterruptions();
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
