// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file job_scripts.h Workers beyond this machine: as a job array of Slurm, or as commands. */
#pragma once

#include "command_line.h"

#include <string>

namespace fastlio
{
/** A script for sbatch. */
[[nodiscard]] std::string slurmScript(const TuneCommand& command);

/** One command a line, for GNU parallel or ssh. */
[[nodiscard]] std::string workerCommands(const TuneCommand& command);

/** Adds the jobs that are known before any result to the store, and prints a script. */
void printScript(const TuneCommand& command);
}  // namespace fastlio
