// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file capture_writer.h Captures of UDP packets for tests: pcap and pcapng. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** A packet and when it came. */
struct SentPacket
{
  std::int64_t stamp_ns = 0;
  std::uint16_t port = 2368;
  std::string payload;
  std::uint8_t sender = 201;  //!< last number of the address 192.168.1.x
};

/** How a capture is written. */
struct CaptureStyle
{
  std::size_t most = 65000;  //!< bytes of an IP packet's data: longer ones come in fragments
  bool vlan = false;
  bool next_generation = false;  //!< pcapng
  bool interleaved = false;      //!< the second fragments come after all first ones
};

std::string captureOf(const std::vector<SentPacket>& packets, const CaptureStyle& style = {});

}  // namespace fastlio::testing
