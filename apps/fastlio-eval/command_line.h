// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file command_line.h The options of fastlio-eval. */
#pragma once

#include <fastlio/evaluation/gates.h>
#include <fastlio/evaluation/trajectory_io.h>

#include <CLI/CLI.hpp>

namespace fastlio
{
/** The arguments of the program. */
struct EvalCommand
{
  std::filesystem::path reference;
  std::vector<std::filesystem::path> estimates;  //!< files, or folders of runs
  KittiTiming kitti;
  EvaluationOptions evaluation;
  GateLimits gates;
  std::string json_path;           //!< "-": standard output; empty: none
  std::filesystem::path svg_path;  //!< empty: none
  bool quiet = false;              //!< no table: only the exit status and the files
};

/** Declares the options on an application, bound to a command that must outlive it. */
void addOptions(CLI::App& app, EvalCommand& command);

}  // namespace fastlio
