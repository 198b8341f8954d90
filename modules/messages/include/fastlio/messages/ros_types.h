// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros_types.h The types of messages that become observations. */
#pragma once

#include <fastlio/messages/packet_topics.h>
#include <fastlio/messages/ros_messages.h>

#include <optional>
#include <string>

namespace fastlio
{
/** The use of a message. */
enum class RosRole
{
  Observation,
  Transforms,     //!< where frames are
  Text,           //!< metadata, perhaps
  OusterPackets,  //!< a part of a scan, or an inertial sample
};

/** A row: a type and what is made of it. */
struct RosType
{
  const char* type;     //!< in the form of ROS 1: "sensor_msgs/Imu"
  const char* meaning;  //!< for people
  RosObservation (*read)(WireReader&, const std::string& label) =
      nullptr;  //!< null: it is not read
  RosRole role = RosRole::Observation;
  /** Packets of LiDARs behind a header, which names the frame; nothing: it holds none. */
  std::optional<PacketMessage> packets = std::nullopt;

  /** Its messages become observations of a LiDAR or of an IMU. */
  [[nodiscard]] bool isLidarOrImu() const
  {
    return isTaken() && read != readNavSatFix && read != readOdometry;
  }
  /** Its messages become observations. */
  [[nodiscard]] bool isTaken() const
  {
    return read != nullptr || packets || role == RosRole::OusterPackets;
  }
};

/** The row of a type, in the form of ROS 1 ("sensor_msgs/Imu"), of ROS 2 ("sensor_msgs/msg/Imu") or
 * of DDS ("sensor_msgs::msg::dds_::Imu_"). */
[[nodiscard]] const RosType& rosTypeOf(const std::string& type);

}  // namespace fastlio
