// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Times of the odometry on a recording or a simulated scenario, as rows of a markdown table.

#include "measurement.h"
#include "streaming.h"
#include <fastlio/config/config_yaml.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>

namespace fastlio::benchmarks
{
namespace
{
struct Arguments
{
  std::string recording, scenario, config;
  double duration = 0.0;
  std::vector<int> threads{1, 2};
  int repeats = 5;
  bool header = false;
};

void printHeader()
{
  std::puts(
      "| recording | scans | threads | median | p99 | p99 disturbed | downsample | deskew | "
      "propagate "
      "| "
      "match | update | insert | points | speed-up | x real time | memory MB | digest |");
  std::puts("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
}

double medianOf(const RunTimes& run, double StageTimings::*stage, double p = 0.5)
{
  std::vector<double> values;
  for (const ScanTime& scan : run.scans)
    values.push_back(scan.least.*stage);
  return percentile(std::move(values), p);
}

double disturbedPercentile(const RunTimes& run, double p)
{
  std::vector<double> values;
  for (const ScanTime& scan : run.scans)
    values.insert(values.end(), scan.each.begin(), scan.each.end());
  return percentile(std::move(values), p);
}

double medianPoints(const RunTimes& run)
{
  std::vector<double> values;
  for (const ScanTime& scan : run.scans)
    values.push_back(static_cast<double>(scan.effective_points));
  return percentile(std::move(values), 0.5);
}

void printRow(
    const std::string& name, const RunTimes& run, const RunTimes& reference,
    const StreamingResult& streaming)
{
  std::printf("| %s | %zu | %i ", name.c_str(), run.scans.size(), run.threads);
  const auto total = &StageTimings::total;
  std::printf("| %.3f | %.3f ", medianOf(run, total), medianOf(run, total, 0.99));
  std::printf("| %.3f ", disturbedPercentile(run, 0.99));
  for (auto stage :
       {&StageTimings::downsample, &StageTimings::deskew, &StageTimings::propagate,
        &StageTimings::associate, &StageTimings::update, &StageTimings::insert})
    std::printf("| %.3f ", medianOf(run, stage));
  std::printf(
      "| %.0f | %.2f ", medianPoints(run), medianOf(reference, total) / medianOf(run, total));
  if (streaming.wall_seconds > 0.0)
    std::printf(
        "| %.0f | %.1f ", streaming.recording_seconds / streaming.wall_seconds,
        streaming.memory_over_start_mb);
  else
    std::printf("| - | - ");
  std::printf("| %016llx |\n", static_cast<unsigned long long>(run.digest));
}

Config configOf(const Arguments& arguments)
{
  return arguments.config.empty() ? Config{} : loadConfigFromFile(arguments.config);
}

/** The fastest of several passes; the memory of the first one. */
StreamingResult streamingOf(const Arguments& arguments, int threads)
{
  if (arguments.recording.empty()) return {};
  OdometryOptions parameters = configOf(arguments).odometry;
  parameters.threads = threads;
  StreamingResult best = stream(arguments.recording, parameters);
  for (int i = 1; i < arguments.repeats; ++i)
    best.wall_seconds =
        std::min(best.wall_seconds, stream(arguments.recording, parameters).wall_seconds);
  return best;
}

void run(const Arguments& arguments)
{
  // First, while the memory is that of a program that only streams.
  std::vector<StreamingResult> streaming;
  for (const int threads : arguments.threads)
    streaming.push_back(streamingOf(arguments, threads));
  const Inputs inputs = arguments.recording.empty()
                            ? inputsOfScenario(arguments.scenario, arguments.duration)
                            : inputsOfRecording(arguments.recording, configOf(arguments));
  const auto runs = measure(inputs, arguments.threads, arguments.repeats);
  if (arguments.header) printHeader();
  for (std::size_t i = 0; i < runs.size(); ++i)
    printRow(inputs.name, runs[i], runs.front(), streaming[i]);
}

int parseAndRun(int argc, char** argv)
{
  Arguments arguments;
  CLI::App app("Milliseconds per scan and stage of the odometry, undisturbed (least of repeats).");
  auto* recording = app.add_option("--recording", arguments.recording, "rawlog to run on");
  app.add_option("--scenario", arguments.scenario, "or a simulated scenario")->excludes(recording);
  app.add_option("--duration", arguments.duration, "of the scenario [s]; 0: its own");
  app.add_option("-c,--config", arguments.config, "parameters (YAML) for a recording");
  app.add_option("--threads", arguments.threads, "numbers of threads to compare")->delimiter(',');
  app.add_option("--repeats", arguments.repeats, "runs per number of threads")
      ->check(CLI::Range(1, 1000));
  app.add_flag("--header", arguments.header, "print the table's head first");
  CLI11_PARSE(app, argc, argv);
  if (arguments.recording.empty() && arguments.scenario.empty()) arguments.scenario = "office";
  run(arguments);
  return EXIT_SUCCESS;
}
}  // namespace
}  // namespace fastlio::benchmarks

int main(int argc, char** argv)
{
  try
  {
    return fastlio::benchmarks::parseAndRun(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
