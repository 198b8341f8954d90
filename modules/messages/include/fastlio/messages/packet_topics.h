// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_topics.h Raw packets of LiDARs in messages, as drivers record them. */
#pragma once

#include <fastlio/messages/ros_messages.h>
#include <fastlio/messages/wire_reader.h>
#include <fastlio/packets/packet_streams.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
/** How messages hold their packets, after the header. */
enum class PacketMessage
{
  Fixed,   //!< a sequence of: stamp, 1500 bytes, how many of them count
  Varied,  //!< a sequence of: stamp, bytes
  Single,  //!< two flags, bytes
};

/** Each topic is a sender, and the label of its observations; of samples "_imu" follows. */
class PacketTopics
{
 public:
  /** \param recording beside which a table of angles may lie */
  explicit PacketTopics(std::string recording) : recording_(std::move(recording)) {}

  /** \exception std::runtime_error the message is damaged */
  void take(const std::string& topic, PacketMessage kind, WireReader& in);

  /** The scans that have begun are complete. */
  void flush();

  /** What is complete, each with the frame of its topic's messages: that of the LiDAR, also for
   * samples of its IMU. */
  [[nodiscard]] std::vector<RosObservation> takeObservations();

  /** Why the packets of a topic cannot be read; each reason is given once. */
  [[nodiscard]] std::optional<std::string> takeProblem();

 private:
  void takePacket(const std::string& topic, const std::uint8_t* data, std::size_t size);
  [[nodiscard]] std::string frameOf(const std::string& label) const;

  std::string recording_;
  std::optional<PacketStreams> streams_;       // since the first packet
  ObservationQueue queue_;                     // complete, and not taken yet
  std::map<std::string, std::string> frames_;  // by topic
  std::vector<std::string> problems_;
};

}  // namespace fastlio
