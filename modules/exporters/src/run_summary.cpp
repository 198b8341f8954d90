// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/run_summary.h>

namespace fastlio
{
ExitStatus exitStatusOf(const RunSummary& summary)
{
  if (summary.interrupted) return ExitStatus::Interrupted;
  if (!summary.output_problems.empty()) return ExitStatus::OutputFailed;
  if (!summary.input_problems.empty()) return ExitStatus::InputBroken;
  const bool diverged = summary.statistics.count(ScanStatus::Diverged) > 0;
  if (!summary.failure.empty() || diverged || summary.statistics.poses() == 0)
    return ExitStatus::OdometryFailed;
  return summary.statistics.health().untrusted().empty() ? ExitStatus::Ok : ExitStatus::Degraded;
}

const char* toString(ExitStatus status)
{
  switch (status)
  {
    case ExitStatus::Ok:
      return "ok";
    case ExitStatus::Usage:
      return "usage";
    case ExitStatus::InputUnusable:
      return "input_unusable";
    case ExitStatus::InputBroken:
      return "input_broken";
    case ExitStatus::OdometryFailed:
      return "odometry_failed";
    case ExitStatus::OutputFailed:
      return "output_failed";
    case ExitStatus::Degraded:
      return "degraded";
    case ExitStatus::Interrupted:
      return "interrupted";
  }
  return "unknown";
}

double realTimeFactor(const RunSummary& summary)
{
  return summary.wall_seconds > 0 ? summary.statistics.duration() / summary.wall_seconds : 0.0;
}

}  // namespace fastlio
