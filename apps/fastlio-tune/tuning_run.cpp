// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_run.h"

#include <fastlio/config/config_document.h>
#include <fastlio/config/config_yaml.h>
#include <fastlio/files/atomic_file.h>
#include <fastlio/options/number_text.h>
#include <fastlio/tuning/search.h>
#include <fastlio/tuning/search_space.h>
#include <fastlio/tuning/verdict.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kFailed = 1000.0;  // error of a run that failed [m]
constexpr double kLeastError = 1e-6;
constexpr std::size_t kGridSteps = 3;

/** The candidates so far: that of number 0 is the base. */
struct Trials
{
  std::vector<std::string> yaml;
  std::vector<std::vector<double>> errors;
  Ratios ratios;
};

void evaluateAll(const TuneCommand& command, const std::vector<std::string>& yamls, Trials& trials)
{
  JobStore store(command.runner.store);
  std::vector<Job> jobs;
  for (const std::string& yaml : yamls)
    for (const std::string& recording : command.recordings)
      jobs.push_back({yaml, recordingId(command.runner.measure, recording)});
  for (const Job& job : jobs)
    store.add(job);
  runJobs(command.runner, jobs);
  auto job = jobs.begin();
  for (const std::string& yaml : yamls)
  {
    trials.yaml.push_back(yaml);
    std::vector<double> errors, ratios;
    for (std::size_t r = 0; r < command.recordings.size(); ++r, ++job)
    {
      errors.push_back(
          std::clamp(store.result(*job)->error.value_or(kFailed), kLeastError, kFailed));
      ratios.push_back(errors.back() / (trials.errors.empty() ? errors : trials.errors[0])[r]);
    }
    trials.errors.push_back(errors);
    trials.ratios.push_back(ratios);
  }
}

std::unique_ptr<Search> searchOf(const TuneCommand& command, const SearchSpace& space)
{
  if (command.method == "random") return randomSearch(space.size(), command.budget, command.seed);
  if (command.method == "cmaes") return cmaesSearch(space.size(), command.budget, command.seed);
  std::vector<std::size_t> steps;
  std::size_t points = 1;
  for (const SearchKey& key : space)
  {
    steps.push_back(key.values.empty() ? kGridSteps : key.values.size());
    points *= steps.back();
    if (points > command.budget)
      throw std::invalid_argument(
          "the grid has more points than --budget " + std::to_string(command.budget) +
          "; raise it, or search fewer keys");
  }
  return gridSearch(steps);
}

void requireInputs(const TuneCommand& command)
{
  for (const std::string& recording : command.recordings)
    for (const std::string& file : {recording, truthOf(recording)})
      if (!std::filesystem::is_regular_file(file))
        throw std::invalid_argument(
            "'" + file + "' is not a file; each NAME.rawlog needs its truth NAME.gt.tum beside it");
}

void printTable(const TuneCommand& command, const Trials& trials, const Verdict& verdict)
{
  std::cout << command.runner.measure << " [" << (command.runner.measure == "ape" ? "m" : "m/s")
            << "]: base, best, ratio; ratio of what the other recordings choose\n";
  for (std::size_t r = 0; r < command.recordings.size(); ++r)
  {
    std::cout << "  " << fixedText(trials.errors[0][r], 4) << "  "
              << fixedText(trials.errors[verdict.best][r], 4) << "  "
              << fixedText(trials.ratios[verdict.best][r], 3) << "  "
              << (verdict.left_out.empty() ? "-" : fixedText(verdict.left_out[r], 3)) << "  "
              << command.recordings[r] << '\n';
  }
}

bool conclude(const TuneCommand& command, const Trials& trials)
{
  const Verdict verdict = leaveOneOut(trials.ratios);
  printTable(command, trials, verdict);
  if (!verdict.recommended)
  {
    std::cout << "Keep the base parameters: "
              << (command.recordings.size() < 2
                      ? "one recording cannot show that others gain, give more.\n"
                      : "no others are better on recordings that did not choose them.\n");
    return false;
  }
  std::string evidence = "# Chosen by fastlio-tune. Error (" + command.runner.measure +
                         ") relative to the base parameters, when the others choose:\n";
  for (std::size_t r = 0; r < command.recordings.size(); ++r)
    evidence += "#   " + fixedText(verdict.left_out[r], 3) + " " +
                std::filesystem::path(command.recordings[r]).filename().string() + "\n";
  writeFileAtomically(command.output, evidence + trials.yaml[verdict.best]);
  std::cout << "Better parameters: " << command.output << '\n';
  return true;
}
}  // namespace

bool tune(const TuneCommand& command)
{
  const SearchSpace space = readSearchSpace(command.space);
  const Config base = command.base.empty() ? Config{} : loadConfigFromFile(command.base);
  requireInputs(command);
  const auto search = searchOf(command, space);
  Trials trials;
  evaluateAll(command, {toYaml(base)}, trials);
  for (auto batch = search->ask(); !batch.empty(); batch = search->ask())
  {
    std::vector<std::string> yamls;
    for (const Places& places : batch)
      yamls.push_back(toYaml(configured(base, space, candidateAt(space, places))));
    const std::size_t first = trials.yaml.size();
    evaluateAll(command, yamls, trials);
    std::vector<double> scores;
    for (std::size_t i = first; i < trials.ratios.size(); ++i)
      scores.push_back(meanRatio(trials.ratios[i]));
    search->tell(scores);
    std::cerr << trials.yaml.size() - 1 << " parameter sets tried\n";
  }
  return conclude(command, trials);
}
}  // namespace fastlio
