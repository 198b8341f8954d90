// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report.h A report for people (table, picture) and for machines (JSON). */
#pragma once

#include <fastlio/evaluation/gates.h>

namespace fastlio
{
/** A table with units, a few dozen lines of at most 100 columns. */
[[nodiscard]] std::string toTable(
    const EvaluationReport& report, const std::vector<GateResult>& gates = {});

/** JSON object; keys carry their units. Absent measures are null. */
[[nodiscard]] std::string toJson(
    const EvaluationReport& report, const std::vector<GateResult>& gates = {});

/** A self-contained SVG picture: both paths from above, the height with three standard deviations
 * and the errors over time. */
[[nodiscard]] std::string toSvg(const EvaluationReport& report);

/** One of several estimates against one reference. */
struct NamedReport
{
  std::string name;
  EvaluationReport report;
  std::vector<GateResult> gates = {};
};

/** A table with a row per estimate; a single one is reported in full. */
[[nodiscard]] std::string toTable(const std::vector<NamedReport>& reports);

/** JSON object with the reports of all estimates, each as toJson() with its name; a single one
 * without it. */
[[nodiscard]] std::string toJson(const std::vector<NamedReport>& reports);

/** One picture of all estimates.
 * \exception std::invalid_argument there is none */
[[nodiscard]] std::string toSvg(const std::vector<NamedReport>& reports);

}  // namespace fastlio
