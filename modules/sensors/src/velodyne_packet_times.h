// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_packet_times.h When the packets of a sweep were fired, by stamps of which some may
 * be corrupt. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** What a packet says about its time. */
struct PacketTime
{
  std::uint32_t stamp_us = 0;  //!< of its first firing, past the hour
  double duration_us = 0.0;    //!< until its last firing is over
};

/** Offset of each packet's first firing to that of the first packet [us], within the longest sweep.
 * A stamp does not fit when it is off from those of most packets, each seen from its place among
 * them, when it repeats the one before, or when it is out of sequence. The packet then has the time
 * at which it was due.
 * \param bad counts the stamps that do not fit */
[[nodiscard]] std::vector<double> packetOffsets(
    const std::vector<PacketTime>& packets, std::size_t& bad);

}  // namespace fastlio
