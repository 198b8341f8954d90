// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_advice.h Meaning of each cause of trouble, and advice. */
#pragma once

#include <fastlio/interface/scan_result.h>

#include <string>
#include <vector>

namespace fastlio
{
/** In plain words, one sentence or two each. docs/troubleshooting.md says more. */
struct HealthAdvice
{
  const char* meaning = "";
  const char* remedy = "";
};

[[nodiscard]] HealthAdvice adviceOf(HealthCause cause);

/** Every cause but None. */
[[nodiscard]] std::vector<HealthCause> allHealthCauses();

/** The cause as HTML that leads to its advice on the page. */
[[nodiscard]] std::string causeLink(HealthCause cause);

}  // namespace fastlio
