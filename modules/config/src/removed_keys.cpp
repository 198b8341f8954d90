// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "removed_keys.h"

#include <algorithm>

namespace fastlio
{
namespace
{
using Removed = std::vector<RemovedKey>;

Removed ofTheStart()
{
  return {
      {"initialization.gravity_std",
       "is a constant of the method now, 0.02 m/s^2; remove the line"},
      {"initialization.gyro_bias_std",
       "is a constant of the method now, 1e-05 rad/s; remove the line"},
      {"initialization.velocity_std",
       "is a constant of the method now, 0.001 m/s; remove the line"},
      {"initialization.gravity_model",
       "is gone: gravity is a vector of the state (free), the sphere was no better; remove the "
       "line"},
      {"initialization.motion_points", "is a constant of the method now, 10000; remove the line"},
      {"initialization.motion_velocity_std",
       "is a constant of the method now, 10 m/s; remove the line"},
      {"initialization.motion_max_velocity_std",
       "is a constant of the method now, 0.5 m/s; remove the line"},
      {"lidar.max_waiting", "is a constant of the method now, 10 s; remove the line"},
      {"calibration.time_offset_min_share",
       "is a constant of the method now, 0.3; remove the line"},
      {"initialization.pose_tilt_std", "is a constant of the method now, 0.5 deg; remove the line"},
      {"initialization.map_share", "is a constant of the method now, 0.5; remove the line"},
      {"imu.saturation_std", "is a constant of the method now, 0.5; remove the line"},
      {"imu.gap_periods", "is a constant of the method now, 4; remove the line"},
      {"imu.gap_gyro_std", "is a constant of the method now, 30 deg/s; remove the line"},
      {"imu.gap_accel_std", "is a constant of the method now, 2 m/s^2; remove the line"},
      {"imu.spike_gyro", "is a constant of the method now, 600 deg/s; remove the line"},
      {"imu.spike_accel", "is a constant of the method now, 100 m/s^2; remove the line"},
  };
}

Removed ofTheScan()
{
  return {
      {"features.min_neighbors", "is a constant of the method now, 3; remove the line"},
      {"features.max_planar_smoothness", "is a constant of the method now, 0.2; remove the line"},
      {"features.min_edge_smoothness", "is a constant of the method now, 0.4; remove the line"},
      {"features.max_beam_turn", "is a constant of the method now, 0.1; remove the line"},
      {"features.min_incidence", "is a constant of the method now, 20 deg; remove the line"},
      {"features.max_spacing", "is a constant of the method now, 1 m; remove the line"},
      {"features.range_jump", "is a constant of the method now, 0.1 m; remove the line"},
      {"features.target_edges", "is a constant of the method now, 300; remove the line"},
      {"features.edge_spacing", "is a constant of the method now, 0.2 m; remove the line"},
      {"features.max_edge_distance", "is a constant of the method now, 2 m; remove the line"},
      {"features.max_edge_scatter", "is a constant of the method now, 0.15 m; remove the line"},
      {"downsampling.wide_range", "is a constant of the method now, 20 m; remove the line"},
      {"measurement.max_normalized_residual",
       "is a constant of the method now, 3; remove the line"},
      {"measurement.robust_kernel",
       "is gone: no kernel was better than the gate on the residual; remove the line"},
      {"measurement.robust_scale", "is gone with measurement.robust_kernel; remove the line"},
      {"measurement.min_effective_points", "is a constant of the method now, 20; remove the line"},
      {"measurement.association_iterations", "is a constant of the method now, 2; remove the line"},
      {"map.max_insertion_std", "is a constant of the method now, 0.2 m; remove the line"},
      {"map.min_incidence", "is a constant of the method now, 0.1; remove the line"},
      {"map.max_thickness", "is a constant of the method now, 0.1 m; remove the line"},
      {"reduction.target_points", "is named downsampling.target_points now"},
      {"reduction.wide_points", "is named downsampling.wide_points now"},
      {"reduction.wide_range", "is a constant of the method now, 20 m; remove the line"},
  };
}

Removed ofTheFilter()
{
  return {
      {"health.min_share", "is a constant of the method now, 0.2; remove the line"},
      {"health.max_innovation", "is a constant of the method now, 3; remove the line"},
      {"health.min_information", "is a constant of the method now, 100; remove the line"},
      {"health.max_inflated", "is a constant of the method now, 0.25; remove the line"},
      {"health.max_gyro_bias", "is a constant of the method now, 10 deg/s; remove the line"},
      {"health.max_accel_bias", "is a constant of the method now, 2 m/s^2; remove the line"},
      {"health.max_scan_interval", "is a constant of the method now, 0.5 s; remove the line"},
      {"health.freeze_map",
       "is always on now: scans that match too badly do not join the map; remove the line"},
      {"recovery.patience", "is a constant of the method now, 1 s; remove the line"},
      {"recovery.match_time", "is a constant of the method now, 1.5 s; remove the line"},
      {"recovery.max_heading", "is a constant of the method now, 90 deg; remove the line"},
      {"recovery.min_share", "is a constant of the method now, 0.3; remove the line"},
      {"recovery.accel_std", "is a constant of the method now, 1 m/s^2; remove the line"},
      {"recovery.gyro_std", "is a constant of the method now, 20 deg/s; remove the line"},
      {"update.attitude", "is a constant of the method now, 0.0001 rad; remove the line"},
      {"update.position", "is a constant of the method now, 0.0001 m; remove the line"},
      {"update.velocity", "is a constant of the method now, 0.001 m/s; remove the line"},
      {"update.gyro_bias", "is a constant of the method now, 0.0001 rad/s; remove the line"},
      {"update.accel_bias", "is a constant of the method now, 0.001 m/s^2; remove the line"},
      {"update.gravity", "is a constant of the method now, 0.001 m/s^2; remove the line"},
      {"rest.max_velocity", "is a constant of the method now, 0.1 m/s; remove the line"},
      {"rest.max_displacement", "is a constant of the method now, 0.03 m; remove the line"},
      {"rest.max_rotation", "is a constant of the method now, 0.5 deg; remove the line"},
      {"rest.max_rate_change", "is a constant of the method now, 0.5 deg/s; remove the line"},
      {"rest.max_accel_change", "is a constant of the method now, 0.1 m/s^2; remove the line"},
      {"rest.velocity_std", "is a constant of the method now, 0.01 m/s; remove the line"},
      {"rest.rate_std", "is a constant of the method now, 0.05 deg/s; remove the line"},
      {"rest.map_time", "is a constant of the method now, 3 s; remove the line"},
  };
}

Removed allKeys()
{
  Removed all;
  for (const Removed& keys : {ofTheStart(), ofTheScan(), ofTheFilter()})
    all.insert(all.end(), keys.begin(), keys.end());
  return all;
}
}  // namespace

const std::vector<RemovedKey>& removedKeys()
{
  static const Removed keys = allKeys();
  return keys;
}

const std::vector<RemovedChoice>& removedChoices()
{
  static const std::vector<RemovedChoice> choices = {
      {"map.type", "kdtree", "kdtree is gone: knn finds the same neighbours"},
  };
  return choices;
}

std::string_view adviceForKey(std::string_view key)
{
  const auto& keys = removedKeys();
  const auto found = std::find_if(
      keys.begin(), keys.end(), [key](const RemovedKey& removed) { return removed.key == key; });
  return found == keys.end() ? std::string_view{} : found->advice;
}

std::string_view adviceForChoice(std::string_view key, std::string_view value)
{
  const auto& choices = removedChoices();
  const auto found = std::find_if(
      choices.begin(), choices.end(),
      [&](const RemovedChoice& removed) { return removed.key == key && removed.value == value; });
  return found == choices.end() ? std::string_view{} : found->advice;
}

}  // namespace fastlio
