// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "removed_keys.h"

#include <algorithm>

namespace fastlio
{
namespace
{
struct MadeConstant
{
  std::string_view key;
  std::string_view value;
};

constexpr MadeConstant kMadeConstants[] = {
    {"initialization.gravity_std", "0.02 m/s^2"},
    {"initialization.gyro_bias_std", "1e-05 rad/s"},
    {"initialization.velocity_std", "0.001 m/s"},
    {"initialization.motion_points", "10000"},
    {"initialization.motion_velocity_std", "10 m/s"},
    {"initialization.motion_max_velocity_std", "0.5 m/s"},
    {"lidar.max_waiting", "10 s"},
    {"calibration.time_offset_min_share", "0.3"},
    {"initialization.pose_tilt_std", "0.5 deg"},
    {"initialization.map_share", "0.5"},
    {"imu.saturation_std", "0.5"},
    {"imu.gap_periods", "4"},
    {"imu.gap_gyro_std", "30 deg/s"},
    {"imu.gap_accel_std", "2 m/s^2"},
    {"imu.spike_gyro", "600 deg/s"},
    {"imu.spike_accel", "100 m/s^2"},
    {"features.min_neighbors", "3"},
    {"features.max_planar_smoothness", "0.2"},
    {"features.min_edge_smoothness", "0.4"},
    {"features.max_beam_turn", "0.1"},
    {"features.min_incidence", "20 deg"},
    {"features.max_spacing", "1 m"},
    {"features.range_jump", "0.1 m"},
    {"features.target_edges", "300"},
    {"features.edge_spacing", "0.2 m"},
    {"features.max_edge_distance", "2 m"},
    {"features.max_edge_scatter", "0.15 m"},
    {"downsampling.wide_range", "20 m"},
    {"measurement.max_normalized_residual", "3"},
    {"measurement.min_effective_points", "20"},
    {"measurement.association_iterations", "2"},
    {"map.max_insertion_std", "0.2 m"},
    {"map.min_incidence", "0.1"},
    {"map.max_thickness", "0.1 m"},
    {"reduction.wide_range", "20 m"},
    {"health.min_share", "0.2"},
    {"health.max_innovation", "3"},
    {"health.min_information", "100"},
    {"health.max_inflated", "0.25"},
    {"health.max_gyro_bias", "10 deg/s"},
    {"health.max_accel_bias", "2 m/s^2"},
    {"health.max_scan_interval", "0.5 s"},
    {"recovery.patience", "1 s"},
    {"recovery.match_time", "1.5 s"},
    {"recovery.max_heading", "90 deg"},
    {"recovery.min_share", "0.3"},
    {"recovery.accel_std", "1 m/s^2"},
    {"recovery.gyro_std", "20 deg/s"},
    {"update.attitude", "0.0001 rad"},
    {"update.position", "0.0001 m"},
    {"update.velocity", "0.001 m/s"},
    {"update.gyro_bias", "0.0001 rad/s"},
    {"update.accel_bias", "0.001 m/s^2"},
    {"update.gravity", "0.001 m/s^2"},
    {"rest.max_velocity", "0.1 m/s"},
    {"rest.max_displacement", "0.03 m"},
    {"rest.max_rotation", "0.5 deg"},
    {"rest.max_rate_change", "0.5 deg/s"},
    {"rest.max_accel_change", "0.1 m/s^2"},
    {"rest.velocity_std", "0.01 m/s"},
    {"rest.rate_std", "0.05 deg/s"},
    {"rest.map_time", "3 s"},
};

std::vector<RemovedKey> allKeys()
{
  std::vector<RemovedKey> keys = {
      {"initialization.gravity_model",
       "is gone: gravity is a vector of the state (free), the sphere was no better; remove the "
       "line"},
      {"measurement.robust_kernel",
       "is gone: no kernel was better than the gate on the residual; remove the line"},
      {"measurement.robust_scale", "is gone with measurement.robust_kernel; remove the line"},
      {"reduction.target_points", "is named downsampling.target_points now"},
      {"reduction.wide_points", "is named downsampling.wide_points now"},
      {"health.freeze_map",
       "is always on now: scans that match too badly do not join the map; remove the line"},
      // Of one that is there, a choice that is gone.
      {"map.type: kdtree", "kdtree is gone: knn finds the same neighbours"},
  };
  for (const MadeConstant& made : kMadeConstants)
    keys.push_back(
        {made.key,
         "is a constant of the method now, " + std::string(made.value) + "; remove the line"});
  return keys;
}
}  // namespace

const std::vector<RemovedKey>& removedKeys()
{
  static const std::vector<RemovedKey> keys = allKeys();
  return keys;
}

std::string adviceFor(std::string_view key)
{
  const auto& keys = removedKeys();
  const auto found = std::find_if(
      keys.begin(), keys.end(), [key](const RemovedKey& removed) { return removed.key == key; });
  return found == keys.end() ? std::string() : found->advice;
}

}  // namespace fastlio
