// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file udp_receiver.h Packets from the network. */
#pragma once

#include <fastlio/files/file_descriptor.h>
#include <fastlio/packets/packet_streams.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace fastlio
{
/** The port that a user names, from 1 to 65535. \exception std::invalid_argument it is none */
[[nodiscard]] std::uint16_t udpPort(std::string_view text);

/** Listens on UDP ports of all interfaces. Packets are stamped by the system when they arrive
 * (CLOCK_REALTIME), before they wait for the program. */
class UdpReceiver
{
 public:
  /** \param ports 0: any free one
   * \exception std::runtime_error a port cannot be listened on: which, and why */
  explicit UdpReceiver(const std::vector<std::uint16_t>& ports);

  /** The next packet, whose bytes stay valid until the one after it; nothing if none comes in time.
   */
  [[nodiscard]] std::optional<UdpPacket> next(std::chrono::milliseconds patience);

  /** In the order of the constructor's. */
  [[nodiscard]] const std::vector<std::uint16_t>& ports() const { return ports_; }

 private:
  [[nodiscard]] std::optional<UdpPacket> receive(std::size_t index);

  std::vector<FileDescriptor> sockets_;
  std::vector<std::uint16_t> ports_;
  std::vector<std::uint8_t> bytes_;
  std::size_t first_ = 0;  // socket that is looked at first, so that none is starved
};

}  // namespace fastlio
