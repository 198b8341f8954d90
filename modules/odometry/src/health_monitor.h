// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file health_monitor.h Is a scan's pose to be believed, and if not, why? */
#pragma once

#include <fastlio/imu/noise_inflation.h>
#include <fastlio/odometry/parameters.h>
#include <fastlio/odometry/scan_result.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** A scan matches as those before it did: health.min_share holds. (Residuals alone do
 * not tell: along a tunnel they grow although the pose is right but for one direction.) \param
 * points of the scan that could have matched */
[[nodiscard]] bool evidenceIsGood(
    const ScanStatistics& statistics, std::size_t points, const HealthOptions& limits);

/** Gives every scan a health value: the smallest of the measures, each 1/2 at its limit. */
class HealthMonitor
{
 public:
  explicit HealthMonitor(const HealthOptions& limits) : limits_(limits) {}

  /** Sets result.health. \param inflations about the inertial data since the scan before, at least
   */
  void judge(const std::vector<NoiseInflation>& inflations, ScanResult& result);

 private:
  HealthOptions limits_;
  std::int64_t last_ns_ = 0;
  int young_scans_ = 0;  // of a map that does not match much yet
};

}  // namespace fastlio
