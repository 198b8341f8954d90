// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_intake.h Scans in order of time, whatever order and stamps they come with. */
#pragma once

#include <fastlio/lidar/queued_scan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
/** Sorts scans into a queue; sets those aside that come from the past, because they may belong to a
 * clock that was set back. */
class ScanIntake
{
 public:
  /** \param max_step scans that are older than the newest one by more than this come from the past
   * \param max_ahead scans that are newer by more than this are no measure of what is new [s] */
  ScanIntake(double max_step, double max_ahead);

  /** \param scan not empty, with stamps that are times
   * \param clock_offset_ns what is added to the inertial stamps now
   * \param inertial_ns newest inertial stamp, if there is one: scans far ahead of it are not
   * believed
   */
  void add(LidarScan scan, std::int64_t clock_offset_ns, std::optional<std::int64_t> inertial_ns);
  /** Takes scans from the past for those of a clock that was set back, when it was. */
  void reconsider(std::int64_t clock_offset_ns);
  /** Scans from the past are lost. */
  void finish();

  [[nodiscard]] const ScanQueue& queue() const { return queue_; }
  /** Takes the oldest scan out of the queue, which is not empty. */
  [[nodiscard]] QueuedScan takeOldest();
  /** The oldest scan ends no later than the one that was taken before it. */
  [[nodiscard]] bool oldestIsRepeated() const
  {
    return taken_ns_ && queue_.front().span.end_ns <= *taken_ns_;
  }
  /** Scans that came too late for the queue. */
  [[nodiscard]] std::size_t late() const { return late_; }
  /** Scans with stamps far in the future that were left out. */
  [[nodiscard]] std::size_t badStamps() const { return bad_stamps_; }

 private:
  void sortIn(QueuedScan scan);
  void dropFuture();

  std::int64_t max_step_ns_, max_ahead_ns_;
  std::int64_t offset_ns_ = 0;             // added to the stamps of scans
  std::optional<std::int64_t> newest_ns_;  // end of the newest believed scan
  std::optional<std::int64_t> ahead_ns_;   // of a scan far ahead that awaits confirmation
  std::optional<std::int64_t> taken_ns_;   // the latest end of a scan that was taken
  std::size_t believed_ = 0;
  ScanQueue queue_;
  std::vector<QueuedScan> past_;  // with their own stamps
  std::size_t late_ = 0, bad_stamps_ = 0;
};

}  // namespace fastlio
