// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file udp_capture.h UDP packets out of captures of a network: pcap and pcapng. */
#pragma once

#include <fastlio/packets/packet_streams.h>

#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct pcap;

namespace fastlio
{
/** Reads a capture with libpcap, which bounds the size of its packets, and puts packets that came
 * in fragments together. */
class UdpCapture
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit UdpCapture(const std::string& path);
  ~UdpCapture();
  UdpCapture(const UdpCapture&) = delete;
  UdpCapture& operator=(const UdpCapture&) = delete;

  /** The next UDP packet, whose bytes stay valid until the one after it, over IPv4 or IPv6; nothing
   * at the end, which failure() may explain. */
  [[nodiscard]] std::optional<UdpPacket> next();

  /** Why reading has ended; empty: the file has. */
  [[nodiscard]] const std::string& failure() const { return failure_; }

  [[nodiscard]] std::uint64_t position() const;

 private:
  struct View
  {
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;
  };
  /** The parts of a packet that have come so far. */
  struct Fragments
  {
    std::string key;  // source, target, number
    std::vector<std::uint8_t> bytes;
    std::size_t received = 0, total = 0;  // total 0: the last one has not come
  };

  [[nodiscard]] std::optional<View> ipOf(View frame) const;
  [[nodiscard]] std::optional<UdpPacket> udpOverIp4(View ip);
  [[nodiscard]] static std::optional<UdpPacket> udpOverIp6(View ip);
  [[nodiscard]] std::optional<View> join(View ip, View payload);

  std::unique_ptr<pcap, void (*)(pcap*)> pcap_;
  int link_ = 0;
  std::list<Fragments> fragments_;
  std::vector<std::uint8_t> joined_;
  std::string failure_;
};

[[nodiscard]] bool isCapture(const std::string& path);

}  // namespace fastlio
