// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/run/run_summary.h>

#include <algorithm>
#include <array>
#include <iterator>
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

struct StatusRow
{
  ExitStatus status;
  const char *name, *words;
};

/** From the gravest to the least. */
constexpr std::array<StatusRow, 9> kStatuses = {
    {{ExitStatus::Interrupted, "interrupted", "interrupted"},
     {ExitStatus::OutputFailed, "output_failed", "outputs incomplete"},
     {ExitStatus::Usage, "usage", "not run: usage"},
     {ExitStatus::InputUnusable, "input_unusable", "input unusable"},
     {ExitStatus::InputBroken, "input_broken", "input damaged"},
     {ExitStatus::OdometryFailed, "odometry_failed", "diverged"},
     {ExitStatus::Degraded, "degraded", "degraded"},
     {ExitStatus::Ok, "ok", "ok"},
     {static_cast<ExitStatus>(-1), "unknown", "unknown"}}};

const StatusRow* rowOf(ExitStatus status)
{
  const auto is_it = [status](const StatusRow& row) { return row.status == status; };
  return std::find_if(kStatuses.begin(), std::prev(kStatuses.end()), is_it);
}
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
  return rowOf(status)->name;
}

std::string statusText(ExitStatus status)
{
  return std::string(toString(status)) + " (exit status " +
         std::to_string(static_cast<int>(status)) + ")";
}

const char* wordsOf(ExitStatus status)
{
  return rowOf(status)->words;
}

ExitStatus graver(ExitStatus a, ExitStatus b)
{
  return std::min(rowOf(a), rowOf(b))->status;
}

std::vector<NamedCount> losses(const RunSummary& run)
{
  std::vector<NamedCount> counts = run.input_counts, lost;
  const PointTotals& points = run.statistics.points();
  counts.push_back({"points_too_near", points.near});
  counts.push_back({"points_too_far", points.far});
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
