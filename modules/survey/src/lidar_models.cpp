// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/survey/lidar_models.h>

namespace fastlio
{
namespace
{
using Presets = std::vector<Preset>;

// Places of built-in IMUs [m].
const Vec3 kOusterImu(0.006253, -0.011775, 0.007645);
const Vec3 kAviaImu(-0.04165, -0.02326, 0.0284);
const Vec3 kHorizonImu(-0.05512, -0.02226, 0.0297);
const Vec3 kMid360Imu(0.011, 0.02329, -0.04412);

constexpr std::string_view kOusterFrame =
    "The IMU's place is given in the sensor frame (x forward), in which Ouster's drivers deliver "
    "the points; sensors differ by a few millimetres, their own metadata "
    "(imu_to_sensor_transform) hold the exact values";
constexpr std::string_view kLivoxUnits =
    "Livox drivers deliver acceleration in g; points come in frames of 0.1 s with times of their "
    "own";

Presets velodyne()
{
  return {
      {"velodyne_vlp16", "Velodyne VLP-16, Puck LITE", "vlp16 vlp-16 puck", 16, -15, 15, true, 0.5,
       150.0, 0.02, std::nullopt, "VLP-16 user manual 63-9243: 100 m, accuracy 3 cm typical", ""},
      {"velodyne_hdl32e", "Velodyne HDL-32E", "hdl32 hdl-32", 32, -30.67, 10.67, true, 1.0, 100.0,
       0.02, std::nullopt, "HDL-32E data sheet 97-0038: 80 to 100 m, accuracy 2 cm (1 sigma)", ""},
      {"velodyne_vlp32c", "Velodyne VLP-32C, Ultra Puck", "vlp32 vlp-32 vlp_32", 32, -25, 15, true,
       0.5, 200.0, 0.02, std::nullopt, "VLP-32C user manual 63-9325: 200 m, accuracy 3 cm typical",
       ""},
      {"velodyne_hdl64e", "Velodyne HDL-64E S2, S3", "hdl64 hdl-64 kitti", 64, -24.9, 2, true, 0.9,
       120.0, 0.02, std::nullopt,
       "HDL-64E S3 user manual 63-HDL64ES3: 120 m, 0.9 m at least, accuracy below 2 cm (1 sigma)",
       "Raw packets need the calibration of the very sensor in the recording"},
  };
}

Presets ouster()
{
  return {
      {"ouster_os0", "Ouster OS0-32, -64, -128", "os0 os-0", 0, -45, 45, true, 0.3, 100.0, 0.02,
       kOusterImu,
       "OS0 data sheet rev. 6: 0.3 m to 50 m (80 %), precision 1 to 5 cm; software user "
       "manual: imu_to_sensor_transform",
       kOusterFrame},
      {"ouster_os1", "Ouster OS1-16, -32, -64, -128", "os1 os-1 ouster", 0, -22.5, 22.5, true, 0.5,
       170.0, 0.02, kOusterImu,
       "OS1 data sheets rev. 6 and 7: 0.3 or 0.5 m to 120 or 170 m (80 %), precision 0.7 to 5 cm; "
       "software user manual: imu_to_sensor_transform",
       kOusterFrame},
      {"ouster_os2", "Ouster OS2-32, -64, -128", "os2 os-2", 0, -11.25, 11.25, true, 1.0, 240.0,
       0.03, kOusterImu,
       "OS2 data sheet rev. 6: 1 m to 240 m (80 %), precision 2.5 to 8 cm; software "
       "user manual: imu_to_sensor_transform",
       kOusterFrame},
  };
}

Presets livox()
{
  return {
      {"livox_avia", "Livox Avia", "avia livox", 0, -38.6, 38.6, false, 1.0, 450.0, 0.02, kAviaImu,
       "Livox Avia user manual v1.0: below 1 m not precise, 450 m (80 %), 2 cm (1 sigma) at 20 m; "
       "place of the IMU in point cloud coordinates",
       kLivoxUnits},
      {"livox_horizon", "Livox Horizon", "horizon", 0, -12.55, 12.55, false, 0.5, 260.0, 0.02,
       kHorizonImu,
       "Livox Horizon user manual v1.0: 260 m (80 %), 2 cm (1 sigma) at 20 m; place of "
       "the IMU in point cloud coordinates",
       kLivoxUnits},
      {"livox_mid360", "Livox Mid-360", "mid360 mid-360 mid_360", 0, -7, 52, true, 0.3, 70.0, 0.02,
       kMid360Imu,
       "Livox Mid-360 user manual: 70 m (80 %), 2 cm (1 sigma) at 10 m, 3 cm at 0.2 m; "
       "place of the IMU in point cloud coordinates (11.0, 23.29, -44.12 mm)",
       kLivoxUnits},
  };
}

Presets hesai()
{
  return {
      {"hesai_pandar64", "Hesai Pandar64, Pandar40", "pandar64 pandar40 pandar hesai", 0, -25, 15,
       true, 0.5, 200.0, 0.02, std::nullopt,
       "Pandar64 user manual 640-en: 0.3 m to 200 m (10 %), accuracy 2 cm (0.5 m and more)",
       "Hesai's drivers give absolute times in seconds; they need fields of 64 bits"},
      {"hesai_pandar128", "Hesai Pandar128", "pandar128 pandar_128", 128, -25, 15, true, 0.5, 200.0,
       0.02, std::nullopt, "Pandar128E3X user manual 128-en: 0.3 m to 200 m (10 %), accuracy 2 cm",
       "Hesai's drivers give absolute times in seconds; they need fields of 64 bits"},
      {"hesai_xt32", "Hesai PandarXT-16, -32, XT32M", "pandarxt xt32 xt16 hesai_xt", 32, -16, 15,
       true, 0.3, 120.0, 0.01, std::nullopt,
       "PandarXT user manual X01-en: 0.05 m to 120 m (10 %), accuracy 1 cm, precision 0.5 cm",
       "Hesai's drivers give absolute times in seconds; they need fields of 64 bits"},
  };
}

Presets robosense()
{
  return {
      {"robosense_rs16", "RoboSense RS-LiDAR-16", "rs16 rs-16 rslidar robosense", 16, -15, 15, true,
       0.4, 150.0, 0.02, std::nullopt,
       "RS-LiDAR-16 user manual v4: 0.4 m to 150 m, accuracy 2 cm typical",
       "Robosense's drivers give absolute times in seconds; they need fields of 64 bits"},
      {"robosense_helios", "RoboSense RS-Helios-16P, -32", "helios", 32, -55, 15, true, 0.2, 150.0,
       0.02, std::nullopt, "RS-Helios user manual: 0.2 m to 150 m, accuracy 2 cm typical",
       "Robosense's drivers give absolute times in seconds; they need fields of 64 bits"},
  };
}

Presets makeTable()
{
  Presets table;
  for (const Presets& maker : {velodyne(), ouster(), livox(), hesai(), robosense()})
    table.insert(table.end(), maker.begin(), maker.end());
  return table;
}
}  // namespace

const std::vector<Preset>& presetTable()
{
  static const Presets table = makeTable();
  return table;
}

}  // namespace fastlio
