// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file lidar_clock.h Stamps of raw scans on the clock of the poses. */
#pragma once

#include <fastlio/interface/scan_result.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace fastlio
{
/** The offset of the LiDAR's clock: what was given, and what the filter has found since. */
class LidarClock
{
 public:
  /** \param given lidar.time_offset [s] */
  explicit LidarClock(double given) : given_ns_(toNanoseconds(given)) {}

  /** In time order. */
  void add(const ScanResult& result)
  {
    if (!hasPose(result.status)) return;
    found_.emplace_back(result.stamp_ns, toNanoseconds(result.filter.x.time_offset));
  }

  /** On the clock of the poses, with the offset that was known when the odometry took the scan.
   * \param stamp_ns of a raw scan */
  [[nodiscard]] std::int64_t poseTimeOf(std::int64_t stamp_ns) const
  {
    stamp_ns += given_ns_;
    const auto next = std::lower_bound(
        found_.begin(), found_.end(), stamp_ns,
        [](const Found& found, std::int64_t stamp) { return found.first < stamp; });
    return next == found_.begin() ? stamp_ns : stamp_ns + std::prev(next)->second;
  }

 private:
  using Found = std::pair<std::int64_t, std::int64_t>;  // the end of a scan, the offset then [ns]

  std::int64_t given_ns_;
  std::vector<Found> found_;
};

}  // namespace fastlio
