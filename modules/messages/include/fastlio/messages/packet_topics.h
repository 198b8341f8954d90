// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_topics.h Raw packets of LiDARs in messages, as drivers record them. */
#pragma once

#include <fastlio/messages/wire_reader.h>
#include <fastlio/packets/packet_streams.h>

#include <cstddef>
#include <string>

namespace fastlio
{
/** How messages hold their packets, after the header. */
enum class PacketMessage
{
  Fixed,   //!< a sequence of: stamp, 1500 bytes, how many of them count
  Varied,  //!< a sequence of: stamp, bytes
  Single,  //!< two flags, bytes
};

/** Each topic is a sender, and the label of its observations. */
class PacketTopics
{
 public:
  /** \return the frame of the message
   * \exception std::runtime_error the message is damaged, or its packets cannot be read */
  std::string take(
      const std::string& topic, PacketMessage kind, WireReader& in, ObservationQueue& out);

  void flush(ObservationQueue& out);

 private:
  void takePacket(const std::string& topic, const std::uint8_t* data, std::size_t size);
  static void rename(ObservationQueue& from, ObservationQueue& to);

  PacketStreams streams_;
  ObservationQueue queue_;  // of the message at hand
};

}  // namespace fastlio
