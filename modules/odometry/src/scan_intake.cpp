// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_intake.h"

#include <fastlio/math/time.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostPast = 64;    // a clock step is known long before
constexpr std::size_t kMostFuture = 16;  // more are no accident, but still no scans
constexpr std::size_t kFewBelieved = 3;  // so few may have had wrong stamps themselves

QueuedScan shifted(QueuedScan scan, std::int64_t shift_ns)
{
  scan.scan.stamp_ns += shift_ns;
  scan.span.begin_ns += shift_ns;
  scan.span.end_ns += shift_ns;
  return scan;
}
}  // namespace

ScanIntake::ScanIntake(double max_step, double max_ahead)
    : max_step_ns_(toNanoseconds(max_step)), max_ahead_ns_(toNanoseconds(max_ahead))
{
}

QueuedScan ScanIntake::takeOldest()
{
  QueuedScan scan = std::move(queue_.front());
  queue_.pop_front();
  taken_ns_ = std::max(taken_ns_.value_or(scan.span.end_ns), scan.span.end_ns);
  return scan;
}

void ScanIntake::sortIn(QueuedScan scan)
{
  const auto after = std::upper_bound(
      queue_.begin(), queue_.end(), scan.span.end_ns,
      [](std::int64_t end_ns, const QueuedScan& s) { return end_ns < s.span.end_ns; });
  queue_.insert(after, std::move(scan));
  dropFuture();
}

/** Scans far ahead of what is new wait for time to reach them, but not many of them. */
void ScanIntake::dropFuture()
{
  const std::int64_t latest_ns = *newest_ns_ + max_ahead_ns_;
  const auto future = std::upper_bound(
      queue_.begin(), queue_.end(), latest_ns,
      [](std::int64_t end_ns, const QueuedScan& s) { return end_ns < s.span.end_ns; });
  if (queue_.end() - future <= static_cast<std::ptrdiff_t>(kMostFuture)) return;
  queue_.pop_back();
  ++bad_stamps_;
}

void ScanIntake::add(
    LidarScan scan, std::int64_t clock_offset_ns, std::optional<std::int64_t> inertial_ns)
{
  const ScanSpan span = spanOf(scan);
  QueuedScan queued = {std::move(scan), span};
  const std::int64_t end_ns = span.end_ns + offset_ns_;
  const bool back = newest_ns_ && end_ns < *newest_ns_ - max_step_ns_;
  if (!newest_ns_ || (back && believed_ < kFewBelieved)) newest_ns_ = end_ns;
  if (end_ns < *newest_ns_ - max_step_ns_)
  {
    past_.push_back(std::move(queued));
    reconsider(clock_offset_ns);
    if (past_.size() <= kMostPast) return;
    past_.erase(past_.begin());
    ++late_;
    return;
  }
  const bool confirmed = ahead_ns_ && std::abs(end_ns - *ahead_ns_) <= max_ahead_ns_ &&
                         (!inertial_ns || end_ns - *inertial_ns <= max_ahead_ns_);
  if (end_ns - *newest_ns_ > max_ahead_ns_ && !confirmed)
    ahead_ns_ = end_ns;
  else
  {
    newest_ns_ = std::max(*newest_ns_, end_ns);
    ahead_ns_.reset();  // only the very next scan confirms one far ahead
    ++believed_;
  }
  sortIn(shifted(std::move(queued), offset_ns_));
}

void ScanIntake::reconsider(std::int64_t clock_offset_ns)
{
  if (clock_offset_ns == offset_ns_ || past_.empty()) return;
  const std::int64_t end_ns = past_.front().span.end_ns + clock_offset_ns;
  if (end_ns < *newest_ns_ - max_step_ns_ || end_ns > *newest_ns_ + max_ahead_ns_) return;
  offset_ns_ = clock_offset_ns;
  for (QueuedScan& scan : past_)
  {
    newest_ns_ = std::max(*newest_ns_, scan.span.end_ns + offset_ns_);
    sortIn(shifted(std::move(scan), offset_ns_));
  }
  past_.clear();
}

void ScanIntake::finish()
{
  late_ += past_.size();
  past_.clear();
}

}  // namespace fastlio
