// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_outcome.h The outcome of a run of the odometry. */
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace fastlio
{
/** From best to worst: a later one ranks behind an earlier one, whatever the error. */
enum class RunState
{
  Complete,
  Degraded,   //!< stretches cannot be trusted
  Truncated,  //!< the recording, or the trajectory, is cut short
  Lost,       //!< diverged or never initialised
  Failed      //!< no trajectory: see the message
};

/** "complete", "degraded", "truncated", "lost", "failed". */
[[nodiscard]] std::string_view toText(RunState state);

/** \exception std::invalid_argument no name of a state */
[[nodiscard]] RunState runStateOf(std::string_view text);

/** Numbers by name: "ape", "rpe", "proxy", ...; smaller is better. */
using Measures = std::map<std::string, double>;

struct RunOutcome
{
  RunState state = RunState::Failed;
  Measures measures;
  std::string message;   //!< why it failed
  double seconds = 0.0;  //!< that it took

  /** Nothing when the run has none of that name, or it is not finite. */
  [[nodiscard]] std::optional<double> measure(const std::string& name) const;
};

}  // namespace fastlio
