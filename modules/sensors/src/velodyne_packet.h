// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_packet.h The fields of a raw packet, byte by byte: little endian, and not aligned
 * (MRPT's own accessors bind references to them, which is undefined behaviour). */
#pragma once

#include <fastlio/math/little_endian.h>

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>
#include <cstdint>

namespace fastlio
{
using VelodynePacket = mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket;
using VelodyneBlock = mrpt::obs::CObservationVelodyneScan::raw_block_t;

namespace packet_layout
{
constexpr std::size_t kHeader = 0, kAzimuth = 2, kReturns = 4, kBytesPerReturn = 3;  // in a block
constexpr std::size_t kIntensity = 2;                                                // in a return

inline std::uint16_t uint16At(const void* object, std::size_t offset)
{
  return littleAt<std::uint16_t>(static_cast<const unsigned char*>(object) + offset);
}
}  // namespace packet_layout

/** 0xEEFF or 0xDDFF. */
inline std::uint16_t headerOf(const VelodyneBlock& block)
{
  return packet_layout::uint16At(&block, packet_layout::kHeader);
}

/** [0.01 deg] */
inline int azimuthOf(const VelodyneBlock& block)
{
  return packet_layout::uint16At(&block, packet_layout::kAzimuth);
}

/** [2 mm]; zero: no echo */
inline int distanceOf(const VelodyneBlock& block, std::size_t index)
{
  return packet_layout::uint16At(
      &block, packet_layout::kReturns + packet_layout::kBytesPerReturn * index);
}

inline std::uint8_t intensityOf(const VelodyneBlock& block, std::size_t index)
{
  const auto* bytes = reinterpret_cast<const unsigned char*>(&block) + packet_layout::kReturns;
  return bytes[packet_layout::kBytesPerReturn * index + packet_layout::kIntensity];
}

}  // namespace fastlio
