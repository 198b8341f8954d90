// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_merger.h Several LiDARs as one: the points of the others join the first one's scans.
 */
#pragma once

#include <fastlio/lidar/scan.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace fastlio
{
/** Holds scans of the first LiDAR back until those of the others that overlap them in time are
 * there. A merged scan is in the frame of the first LiDAR; every point keeps its own time. Not
 * thread-safe. */
class ScanMerger
{
 public:
  /** \param lidar 0 is the first */
  void add(std::size_t lidar, LidarScan scan);

  /** The oldest scan of the first LiDAR, if its time is over.
   * \param now_ns stamp that the
   * recording has reached */
  [[nodiscard]] std::optional<LidarScan> next(std::int64_t now_ns);

  /** The same at the end of the recording. Once there is none, what is left of the others is left
   * out. */
  [[nodiscard]] std::optional<LidarScan> flush();

  /** Points of the others that no scan of the first LiDAR is near in time. */
  [[nodiscard]] std::size_t pointsLeftOut() const { return left_out_; }

 private:
  struct Further
  {
    std::size_t lidar;
    LidarScan scan;
  };

  void join(LidarScan& first, const ScanSpan& window, Further& further);

  std::deque<LidarScan> first_;
  std::deque<Further> further_;  // what has not been taken yet
  std::size_t left_out_ = 0;
};

}  // namespace fastlio
