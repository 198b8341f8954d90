// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file main.cpp fastlio-tune: parameters that make the error on recordings smaller. */

#include "tuning_run.h"

#include <CLI/CLI.hpp>

#include <iostream>

int main(int argc, char** argv)
try
{
  fastlio::TuneCommand c;
  CLI::App app{
      "Searches parameters with a smaller error on recordings with ground truth.", "fastlio-tune"};
  app.set_version_flag("--version", "fastlio-tune " MRPT_FASTLIO_VERSION);
  app.footer(
      "Exit status:\n  0  better parameters are written\n  1  wrong usage or input\n"
      "  2  keep the base parameters: nothing is written");
  app.add_option("space", c.space, "Search space (docs/tuning.md)")
      ->required()
      ->type_name("SPACE.yaml");
  app.add_option("recordings", c.recordings, "NAME.rawlog, with NAME.gt.tum beside it")
      ->required()
      ->type_name("FILE...");
  app.add_option("-c,--config", c.base, "Base parameters; default: the defaults")
      ->type_name("FILE.yaml");
  app.add_option("-o,--output", c.output, "Parameters that are found")->capture_default_str();
  app.add_option("--store", c.runner.store, "Finished runs (SQLite); default: OUTPUT.sqlite");
  app.add_option("--method", c.method, "Search")
      ->check(CLI::IsMember({"cmaes", "random", "grid"}))
      ->capture_default_str();
  app.add_option("--measure", c.runner.measure, "Error: ape [m], or rpe over 1 s [m/s]")
      ->check(CLI::IsMember({"ape", "rpe"}))
      ->capture_default_str();
  app.add_option("--budget", c.budget, "Parameter sets to try")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--seed", c.seed, "Of the search")->capture_default_str();
  app.add_option("-j,--jobs", c.runner.jobs, "Runs at the same time")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--timeout", c.runner.timeout, "A longer run counts as failed [s]")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& e)
  {
    return app.exit(e) == 0 ? 0 : 1;
  }
  if (c.runner.store.empty()) c.runner.store = c.output + ".sqlite";
  return fastlio::tune(c) ? 0 : 2;
}
catch (const std::exception& e)
{
  std::cerr << "fastlio-tune: " << e.what() << '\n';
  return 1;
}
