// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fast_lio_keys.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace fastlio
{
namespace
{
constexpr std::string_view kFastLioGroups[] = {
    "common", "preprocess", "mapping", "publish", "pcd_save"};
}  // namespace

const std::vector<FastLioKey>& fastLioKeys()
{
  // Its filter adds cov dt^2 in a step, the one here density^2 dt.
  static const std::vector<FastLioKey> keys = {
      {"lid_topic",
       "input.lidar_sensor_label, which is the topic in recordings that come from ROS"},
      {"imu_topic", "input.imu_sensor_label, which is the topic in recordings that come from ROS"},
      {"time_sync_en", "nothing: calibration.estimate_time_offset, the default, finds the offset"},
      {"time_offset_lidar_to_imu", "lidar.time_offset, with the same sign"},
      {"lidar_type", "nothing: the recording says which fields its points have"},
      {"scan_line", "nothing: the recording says which laser a point is from"},
      {"scan_rate", "nothing: the stamps of the recording show it"},
      {"timestamp_unit", "nothing: input.point_time_unit is found from the data"},
      {"blind", "lidar.min_range"},
      {"point_filter_num", "downsampling.target_points, a number of points per scan"},
      {"feature_extract_enable", "features.mode: planar_and_edge; none is the default"},
      {"filter_size_surf", "downsampling.target_points, a number of points per scan"},
      {"filter_size_map", "map.voxel_size; 0, the default, follows the sensor"},
      {"cube_side_length", "map.radius, half as long"},
      {"det_range", "lidar.max_range"},
      {"fov_degree", "nothing: it is not needed"},
      {"max_iteration", "update.max_iterations"},
      {"acc_cov", "imu.accel_noise_density of the datasheet; theirs is sqrt(acc_cov / rate)"},
      {"gyr_cov", "imu.gyro_noise_density of the datasheet; theirs is sqrt(gyr_cov / rate)"},
      {"b_acc_cov", "imu.accel_bias_walk; theirs is sqrt(b_acc_cov / rate)"},
      {"b_gyr_cov", "imu.gyro_bias_walk; theirs is sqrt(b_gyr_cov / rate)"},
      {"extrinsic_est_en", "calibration.estimate_extrinsic, or better fastlio-calibrate"},
      {"extrinsic_T",
       "input.T_vehicle_lidar: [x, y, z, yaw, pitch, roll], if the IMU is the vehicle"},
      {"extrinsic_R", "the angles of input.T_vehicle_lidar in degrees, if the IMU is the vehicle"},
      {"pcd_save_en", "output.exporters with pcd, or --export pcd"},
      {"pcd_save.interval",
       "output.tile_size: tiles of the map instead of one file per so many scans"},
      {"path_en", "nothing: trajectory.tum is written by default"},
      {"scan_publish_en", "nothing: a replay publishes nothing"},
      {"dense_publish_en", "nothing: a replay publishes nothing"},
      {"scan_bodyframe_pub_en", "nothing: a replay publishes nothing"},
      {"runtime_pos_log_enable",
       "output.exporters with states and timing, which are written by default"},
  };
  return keys;
}

bool isFastLioGroup(std::string_view name)
{
  return std::find(std::begin(kFastLioGroups), std::end(kFastLioGroups), name) !=
         std::end(kFastLioGroups);
}

std::string adviceForFastLio(std::string_view key)
{
  const auto is_meant = [key](const FastLioKey& theirs)
  {
    const std::size_t group = key.size() - std::min(key.size(), theirs.name.size());
    return key.substr(group) == theirs.name && (group == 0 || key[group - 1] == '.');
  };
  const auto& keys = fastLioKeys();
  const auto found = std::find_if(keys.begin(), keys.end(), is_meant);
  if (found == keys.end()) return {};
  return "is a parameter of FAST_LIO; here: " + std::string(found->instead);
}

}  // namespace fastlio
