// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file tuning_run.h A whole search, and what it says at the end. */
#pragma once

#include "job_runner.h"

#include <cstdint>

namespace fastlio
{
struct TuneCommand
{
  RunnerOptions runner;
  std::string space, base, output = "tuned.yaml", method = "cmaes";
  std::vector<std::string> recordings;
  std::size_t budget = 60;
  std::uint64_t seed = 1;
};

/** \return whether better parameters were written */
bool tune(const TuneCommand& command);
}  // namespace fastlio
