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

/** A reason for data to be dropped. */
struct LossReason
{
  std::string_view count;
  const char* words;
};

constexpr std::array<LossReason, 7> kImuLosses = {
    {{"imu_not_finite", "they hold values that are not finite"},
     {"imu_bad_stamp", "their stamps are no times"},
     {"imu_without_stamp", "they have no stamp"},
     {"imu_duplicate", "their stamps repeat"},
     {"imu_out_of_order", "their stamps are out of order"},
     {"imu_without_acceleration", "they have no acceleration"},
     {"imu_without_angular_rate", "they have no angular rate"}}};
constexpr std::array<LossReason, 4> kScanLosses = {
    {{"scans_out_of_order", "their stamps repeat, or are out of order"},
     {"scans_bad_stamp", "their stamps are no times"},
     {"scans_without_stamp", "they have no stamp"},
     {"scans_unreadable", "they cannot be read"}}};

/** Samples or scans of which more than half were dropped for one reason. */
template <std::size_t Count>
void addLoss(
    const RunSummary& run, std::string_view total, const char* what,
    const std::array<LossReason, Count>& reasons, std::vector<std::string>& sentences)
{
  for (const LossReason& reason : reasons)
    if (const std::size_t lost = inputCount(run, reason.count); 2 * lost > inputCount(run, total))
      sentences.push_back(
          std::to_string(lost) + " " + what + " were dropped: " + std::string(reason.words));
}

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

std::size_t inputCount(const RunSummary& run, std::string_view name)
{
  for (const NamedCount& count : run.input_counts)
    if (count.name == name) return count.count;
  return 0;
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

std::vector<std::string> lossSentences(const RunSummary& run)
{
  std::vector<std::string> sentences;
  addLoss(run, "imu_samples", "inertial samples", kImuLosses, sentences);
  addLoss(run, "scans", "scans", kScanLosses, sentences);
  return sentences;
}

double realTimeFactor(const RunSummary& summary)
{
  return summary.wall_seconds > 0 ? summary.statistics.duration() / summary.wall_seconds : 0.0;
}

}  // namespace fastlio
