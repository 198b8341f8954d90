// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/run/run_summary.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace fastlio
{
namespace
{
/** Counts that are no loss. */
constexpr std::array<std::string_view, 7> kNoLoss = {
    "imu_samples",          "scans",         "points",
    "other_sensors",        "scans_skipped", "scans_with_synthetic_point_times",
    "points_without_return"};  // a beam into the sky has none
}  // namespace

bool isLost(const RunStatistics& statistics)
{
  return statistics.poses() == 0 || statistics.count(ScanStatus::Diverged) > 0 ||
         statistics.health().hasNoMap();
}

ExitStatus exitStatusOf(const RunSummary& summary)
{
  if (summary.interrupted) return ExitStatus::Interrupted;
  if (!summary.output_problems.empty()) return ExitStatus::OutputFailed;
  if (!summary.input_problems.empty()) return ExitStatus::InputBroken;
  if (!summary.failure.empty() || isLost(summary.statistics)) return ExitStatus::OdometryFailed;
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

std::vector<NamedCount> losses(const std::vector<NamedCount>& counts)
{
  std::vector<NamedCount> lost;
  for (const auto& count : counts)
    if (count.count > 0 && std::find(kNoLoss.begin(), kNoLoss.end(), count.name) == kNoLoss.end())
      lost.push_back(count);
  return lost;
}

double realTimeFactor(const RunSummary& summary)
{
  return summary.wall_seconds > 0 ? summary.statistics.duration() / summary.wall_seconds : 0.0;
}

}  // namespace fastlio
