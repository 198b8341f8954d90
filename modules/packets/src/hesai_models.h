// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file hesai_models.h How Hesai's LiDARs lay out their packets, and where their beams point. */
#pragma once

#include <fastlio/packets/packet_streams.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
enum class HesaiKind
{
  Pandar40P,
  Pandar64,
  PandarQT64,
  PandarXT16,
  PandarXT32,
  PandarXT32M,
  Pandar128,  //!< also OT128
};

/** Places in a packet, in bytes, and the times of its blocks. */
struct HesaiLayout
{
  HesaiKind kind = HesaiKind::PandarXT32;
  std::size_t blocks = 0, channels = 0;
  std::size_t head = 0;        //!< before the first block
  std::size_t block_head = 2;  //!< before the azimuth's end: 4 where each block has a mark
  std::size_t unit = 0;        //!< of a channel: range, reflectivity, and what is not used
  std::size_t return_at = 0, date_at = 0, time_at = 0;
  double range_unit = 4e-3;        //!< [m]
  double step_ns = 0;              //!< from firing to firing
  double offset_ns = 0;            //!< of the last firing (or the first one) from the packet's time
  bool from_first = false;         //!< the packet's time is that of its first firing
  bool may_count_seconds = false;  //!< the date may be seconds since 1970 instead

  [[nodiscard]] std::size_t blockBytes() const { return block_head + channels * unit; }
};

/** The layout of a data packet of Hesai; nothing: it is something else. */
[[nodiscard]] std::optional<HesaiLayout> hesaiLayoutOf(const UdpPacket& packet);

/** Angles [rad] and times of firing [ns], by channel. */
struct HesaiBeams
{
  std::vector<double> elevation, azimuth, time_ns;
};

/** As the maker's documents give them; without angles where each sensor has its own. */
[[nodiscard]] HesaiBeams hesaiBeamsOf(HesaiKind kind);

/** The maker's table "Channel,Elevation,Azimuth" in degrees: elevation and azimuth of each channel.
 * Nothing: the text is no such table. */
[[nodiscard]] std::optional<HesaiBeams> hesaiAnglesOf(const std::string& text);

/** The table beside a recording: NAME.csv for NAME.pcap, or for the folder NAME. Nothing: there is
 * none. */
[[nodiscard]] std::optional<HesaiBeams> hesaiAnglesBeside(const std::string& capture);

}  // namespace fastlio
