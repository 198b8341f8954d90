// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ouster_topics.h Raw packets of an Ouster in messages: NAME/lidar_packets and
 * NAME/imu_packets, with NAME/metadata as text. */
#pragma once

#include <fastlio/messages/wire_reader.h>
#include <fastlio/packets/ouster_sensor.h>

#include <map>
#include <memory>
#include <string>

namespace fastlio
{
class OusterTopics
{
 public:
  /** A message of type std_msgs/String may be metadata; nothing happens when it is not. */
  void takeMetadata(const std::string& topic, WireReader& in);

  /** \exception std::runtime_error there is no metadata, or the message is damaged */
  void takePacket(const std::string& topic, WireReader& in, ObservationQueue& out);

  void flush(ObservationQueue& out);

 private:
  std::map<std::string, std::unique_ptr<OusterSensor>> sensors_;  // by the topics' common start
};

}  // namespace fastlio
