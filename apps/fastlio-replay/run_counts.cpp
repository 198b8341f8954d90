// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_counts.h"

#include <mrpt/core/format.h>

#include <algorithm>

namespace fastlio
{
std::vector<NamedCount> inputCounts(const BridgeStatistics& bridge, const InputStatistics& odometry)
{
  std::vector<NamedCount> counts{
      {"imu_samples", bridge.imu_converted},
      {"imu_without_acceleration", bridge.imu_no_acceleration},
      {"imu_without_angular_rate", bridge.imu_no_angular_rate},
      {"imu_not_finite", bridge.imu_not_finite + odometry.imu_not_finite},
      {"imu_without_stamp", bridge.imu_no_stamp},
      {"imu_out_of_order", odometry.imu_out_of_order},
      {"imu_duplicate", odometry.imu_duplicate},
      {"imu_spikes", odometry.imu_spikes},
      {"imu_bad_stamp", odometry.imu_bad_stamps},
      {"scans", bridge.scans_converted},
      {"scans_with_synthetic_point_times", bridge.scans_synthetic_point_times},
      {"scans_without_point_times", bridge.scans_without_point_times},
      {"scans_with_unusable_point_times", bridge.scans_unusable_point_times},
      {"scans_without_stamp", bridge.scans_no_stamp},
      {"scans_unreadable", bridge.scans_unreadable},
      {"scans_empty", odometry.scans_empty},
      {"scans_out_of_order", odometry.scans_out_of_order},
      {"scans_without_imu", odometry.scans_without_imu},
      {"scans_bad_stamp", odometry.scans_bad_stamp},
      {"points", bridge.points_converted},
      {"points_without_return", bridge.points_no_return},
      {"points_out_of_range", bridge.points_out_of_range},
      {"points_invalid", bridge.points_invalid},
      {"points_duplicate", bridge.points_duplicate},
      {"packet_blocks_corrupt", bridge.packet_blocks_corrupt},
      {"packet_times_corrupt", bridge.packet_times_corrupt},
      {"other_sensors", bridge.other_sensors}};
  // Of several LiDARs only.
  if (bridge.points_left_out > 0) counts.push_back({"points_left_out", bridge.points_left_out});
  return counts;
}

std::optional<std::string> leftOutText(const BridgeStatistics& bridge)
{
  constexpr double kConsiderable = 0.1;
  const auto points = static_cast<double>(bridge.points_of_further);
  const double share = static_cast<double>(bridge.points_left_out) / std::max(points, 1.0);
  if (share <= kConsiderable) return std::nullopt;
  return mrpt::format(
      "%.0f %% of the points of the LiDARs beside the first one are left out: no scan of the first "
      "one is near them in time; check its pauses, and the clocks (lidar_2.time_offset and the "
      "like)",
      100.0 * share);
}

std::string lostEndText(const InputStatistics& odometry)
{
  return mrpt::format(
      "the last %zu scans could not be processed: of all scans, %zu were without inertial data, "
      "%zu "
      "were stamped before others, %zu had absurd stamps, %zu were empty",
      odometry.scans_after_result, odometry.scans_without_imu, odometry.scans_out_of_order,
      odometry.scans_bad_stamp, odometry.scans_empty);
}

}  // namespace fastlio
