// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/parsing.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>

namespace fastlio
{
namespace
{
constexpr const char* kFooter =
    "Exit status:\n"
    "    0  better parameters are written\n"
    "    1  wrong usage or input, or a file that cannot be written\n"
    "    2  keep the base parameters: nothing better was found; nothing is written\n"
    "    3  keep the base parameters: what was found is worse on recordings that it was not "
    "chosen\n"
    "       on; nothing is written\n"
    "  130  interrupted; the same command goes on\n\n"
    "Example:\n"
    "  fastlio-tune space.yaml a.rawlog b.rawlog c.rawlog -c my.yaml -j 4";

/** Options that are other tasks. */
struct Tasks
{
  bool rank = false;
  int slurm = 0, parallel = 0;
  std::string work, status;
};

void addFileOptions(CLI::App& app, TuneCommand& c)
{
  app.add_option("space", c.files.space, "Keys and the values that they may take (docs/tuning.md)")
      ->type_name("SPACE.yaml");
  app.add_option("recordings", c.files.recordings, "Recordings, as fastlio-replay reads them")
      ->type_name("RECORDING...");
  app.add_option("-c,--config", c.files.base, "Base parameters; default: the defaults")
      ->type_name("FILE.yaml");
  app.add_option(
         "--truth", c.files.truths,
         "True trajectory of a recording, once per recording and in their order; default: "
         "NAME.gt.tum beside NAME.rawlog")
      ->allow_extra_args(false)
      ->type_name("FILE.tum");
  app.add_option("--frame", c.frame, "Body whose pose the true trajectory holds: vehicle or imu")
      ->check(CLI::IsMember({"vehicle", "imu"}))
      ->capture_default_str();
  app.add_option("-o,--output", c.files.output, "Better parameters")
      ->capture_default_str()
      ->type_name("FILE.yaml");
  app.add_flag(
      "--overwrite", c.overwrite, "Replace FILE.yaml also where fastlio-tune did not write it");
  app.add_option("--json", c.files.json, "Also write the result to this file")
      ->type_name("FILE.json");
  app.add_option(
         "--report", c.files.report,
         "Page with errors, keys and the course of the search; default: OUTPUT with .html")
      ->type_name("FILE.html");
  app.add_option("--store", c.runner.store, "Finished runs (SQLite); default: OUTPUT.sqlite")
      ->type_name("FILE");
}

void addSearchOptions(CLI::App& app, TuneCommand& c)
{
  app.add_option(
         "--method", c.search.method,
         "cmaes follows the better half of each batch, random, grid: all combinations, each: every "
         "key alone")
      ->check(CLI::IsMember({"cmaes", "random", "grid", "each"}))
      ->capture_default_str();
  app.add_option(
         "--measure", c.measure,
         "What gets smaller: ape [m], rpe over 1 s [m/s], proxy (without ground truth); auto: ape "
         "where there is ground truth, else proxy")
      ->check(CLI::IsMember({"auto", "ape", "rpe", "proxy"}))
      ->capture_default_str();
  app.add_option("--budget", c.search.budget, "Parameter sets to try")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--seed", c.search.seed, "Of the search")->capture_default_str();
  app.add_option(
         "-j,--jobs", c.runner.jobs,
         "Runs at the same time; 0: only workers elsewhere (--work) run")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  app.add_option("--timeout", c.runner.timeout, "A longer run counts as failed [s]")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  app.add_flag("--retry-failed", c.retry_failed, "Run again what failed before");
}

void addTaskOptions(CLI::App& app, TuneCommand& c, Tasks& tasks)
{
  app.add_flag(
      "--rank", tasks.rank,
      "Compare the proxy with the true error: rank correlation over --budget random sets");
  app.add_option("--work", tasks.work, "Run the jobs of a store until none is left")
      ->type_name("STORE");
  app.add_option("--wait", c.runner.wait, "--work waits this long for new jobs [s]")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--status", tasks.status, "Print the numbers of jobs in a store")
      ->type_name("STORE");
  app.add_option(
         "--print-slurm", tasks.slurm,
         "Add the jobs to the store and print a job array of N workers for sbatch")
      ->check(CLI::Range(1, 10000))
      ->type_name("N");
  app.add_option(
         "--print-parallel", tasks.parallel,
         "Add the jobs to the store and print N commands for GNU parallel or ssh")
      ->check(CLI::Range(1, 10000))
      ->type_name("N");
  app.add_flag("-q,--quiet", c.quiet, "No progress");
}

void setTask(TuneCommand& c, const Tasks& tasks)
{
  using Task = TuneCommand::Task;
  const int given = static_cast<int>(tasks.rank) + static_cast<int>(!tasks.work.empty()) +
                    static_cast<int>(!tasks.status.empty()) + static_cast<int>(tasks.slurm > 0) +
                    static_cast<int>(tasks.parallel > 0);
  if (given > 1)
    throw CLI::ValidationError(
        "give one of --rank, --work, --status, --print-slurm and --print-parallel");
  if (tasks.rank)
  {
    c.task = Task::Rank;
    c.search.method = "random";
  }
  if (!tasks.work.empty()) c.task = Task::Work;
  if (!tasks.status.empty()) c.task = Task::Status;
  if (tasks.slurm > 0) c.task = Task::PrintSlurm;
  if (tasks.parallel > 0) c.task = Task::PrintParallel;
  c.runner.progress = !c.quiet;
  c.workers = std::max({1, tasks.slurm, tasks.parallel});
  if (c.task == Task::Work || c.task == Task::Status)
  {
    c.runner.store = c.task == Task::Work ? tasks.work : tasks.status;
    if (!std::filesystem::is_regular_file(c.runner.store))
      throw CLI::ValidationError("job store '" + c.runner.store + "' is not there");
    return;
  }
  if (c.files.space.empty())
    throw CLI::RequiredError("a search space (fastlio-tune space.yaml walk.rawlog)");
  if (c.files.recordings.empty())
    throw CLI::RequiredError("a recording (fastlio-tune space.yaml walk.rawlog)");
  if (c.runner.store.empty()) c.runner.store = c.files.output + ".sqlite";
  if (c.files.report.empty())
    c.files.report = std::filesystem::path(c.files.output).replace_extension(".html").string();
}
}  // namespace

std::variant<TuneCommand, int> parseCommandLine(int argc, const char* const* argv)
{
  TuneCommand c;
  Tasks tasks;
  CLI::App app{"Searches parameters with a smaller error on recordings.", "fastlio-tune"};
  addVersion(app, programVersion());
  app.footer(kFooter);
  addFileOptions(app, c);
  addSearchOptions(app, c);
  addTaskOptions(app, c, tasks);
  if (const auto end = endAfterParsing(app, argc, argv, 1, [&] { setTask(c, tasks); })) return *end;
  return c;
}
}  // namespace fastlio
