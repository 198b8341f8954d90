// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/ros_types.h>

#include <array>

namespace fastlio
{
namespace
{
constexpr const char* kLidar = "LiDAR, points and their times as recorded";
constexpr const char* kPackets = "packets of a LiDAR, and of its IMU";

const std::array<RosType, 17> kRosTypes{{
    {"sensor_msgs/Imu", "IMU, units as recorded", readImu},
    {"sensor_msgs/PointCloud2", kLidar, readPointCloud2},
    {"livox_ros_driver/CustomMsg", kLidar, readLivoxCustom},
    {"livox_ros_driver2/CustomMsg", kLidar, readLivoxCustom},
    {"livox_interfaces/CustomMsg", kLidar, readLivoxCustom},
    {"velodyne_msgs/VelodyneScan", "LiDAR, raw packets", readVelodyneScan},
    {"sensor_msgs/NavSatFix", "GNSS", readNavSatFix},
    {"nav_msgs/Odometry", "odometry: planar pose and velocity", readOdometry},
    {"tf2_msgs/TFMessage", "used for the poses of sensors", nullptr, RosRole::Transforms},
    {"ouster_ros/PacketMsg", "packets of an Ouster: LiDAR, IMU", nullptr, RosRole::OusterPackets},
    {"ouster_sensor_msgs/PacketMsg", "packets of an Ouster: LiDAR, IMU", nullptr,
     RosRole::OusterPackets},
    {"pandar_msgs/PandarScan", kPackets, nullptr, {}, PacketMessage::Fixed},
    {"hesai_lidar/PandarScan", kPackets, nullptr, {}, PacketMessage::Fixed},
    {"nebula_msgs/NebulaPackets", kPackets, nullptr, {}, PacketMessage::Varied},
    {"rslidar_msg/RslidarPacket", kPackets, nullptr, {}, PacketMessage::Single},
    {"std_msgs/String", "text: metadata of an Ouster, if it is that", nullptr, RosRole::Text},
    {"tf/tfMessage", "used for the poses of sensors", nullptr, RosRole::Transforms},
}};

const RosType kOther{"", "not read: no type of this program"};

void replace(std::string& text, const std::string& from, const std::string& to)
{
  if (const auto at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
}

std::string plainTypeOf(std::string type)
{
  replace(type, "::msg::dds_::", "/");
  if (!type.empty() && type.back() == '_') type.pop_back();
  replace(type, "/msg/", "/");
  return type;
}
}  // namespace

const RosType& rosTypeOf(const std::string& type)
{
  const std::string plain = plainTypeOf(type);
  for (const RosType& row : kRosTypes)
    if (plain == row.type) return row;
  return kOther;
}

}  // namespace fastlio
