// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gates.h Limits that a report must keep, for automated tests. */
#pragma once

#include <fastlio/evaluation/evaluate.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** What a limit may be set on. */
struct GateKind
{
  const char* name;  //!< as the option of the program, without dashes in front: "max-ape"
  const char* unit;
  const char* text;     //!< for people
  const char* missing;  //!< why a report may lack the measure, and what to do
  /** In the unit; nothing where the report does not have it. */
  std::optional<double> (*measure)(const EvaluationReport& report);
  bool is_least = false;  //!< the limit is the least value that passes, not the largest one
};

/** All of them. */
[[nodiscard]] const std::vector<GateKind>& gateKinds();

/** Limits by the names of gateKinds(), in their units. */
using GateLimits = std::map<std::string, double>;

/** One limit and what was measured. */
struct GateResult
{
  std::string name;  //!< as the option of the program, without dashes in front: "max-ape"
  std::string unit;
  double limit = 0.0;
  double measured = 0.0;
  bool passed = false;
};

/** The limits that are set, in the order of gateKinds(). A measure that is not a number fails.
 * \exception std::invalid_argument a limit is set on something that the report does not have, or has
 * a name that is none; the message says what is missing */
[[nodiscard]] std::vector<GateResult> checkGates(
    const EvaluationReport& report, const GateLimits& limits);

}  // namespace fastlio
