// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h The arguments of fastlio-tune. */
#pragma once

#include "job_runner.h"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** Where and how a search goes. */
struct SearchOptions
{
  std::string method = "cmaes";  //!< cmaes, random, grid, each
  std::size_t budget = 60;       //!< parameter sets
  std::uint64_t seed = 1;
};

/** Which files take part. */
struct TuneFiles
{
  std::string space, base, output = "tuned.yaml", json;
  std::string report;  //!< page; empty: beside the output
  std::vector<std::string> recordings, truths;
};

struct TuneCommand
{
  enum class Task
  {
    Tune,           //!< search, and conclude
    Rank,           //!< compare the proxy with the true error
    Work,           //!< run jobs of a store
    Status,         //!< count the jobs of a store
    PrintSlurm,     //!< add the jobs, print a job array
    PrintParallel,  //!< add the jobs, print a list of commands
  };
  Task task = Task::Tune;
  RunnerOptions runner;
  SearchOptions search;
  TuneFiles files;
  std::string measure = "auto", frame = "vehicle";
  int workers = 1;  //!< that a script starts
  bool retry_failed = false, quiet = false;
  bool overwrite = false;  //!< also an output that the program has not written
};

/** The command, or the exit status after --help or an error that has been printed. */
[[nodiscard]] std::variant<TuneCommand, int> parseCommandLine(int argc, const char* const* argv);
}  // namespace fastlio
