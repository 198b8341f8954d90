// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file turning_lidars.h Packets of Hesai's and RoboSense's LiDARs for tests, byte by byte as their
 * user manuals lay them out. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** A packet of a LiDAR, all of whose pulses have the same range. */
struct TurningPacket
{
  std::int64_t stamp_ns = 0;        //!< the packet's own, a whole number of microseconds
  std::vector<int> azimuths;        //!< of the blocks [0.01 deg]
  std::uint16_t range = 2500;       //!< in the unit of the sensor
  std::uint16_t second = 0;         //!< of every second block; 0: the same
  std::uint8_t return_mode = 0x37;  //!< Hesai's: strongest
};

/** \name Hesai
 * @{ */
std::string xtPacket(const TurningPacket& packet, int channels = 32);
std::string qtPacket(const TurningPacket& packet);
std::string pandar64Packet(const TurningPacket& packet);
std::string pandar40Packet(const TurningPacket& packet);
/** \param flags 0x04: with the part on functional safety, 0x10: with confidences */
std::string pandar128Packet(const TurningPacket& packet, std::uint8_t flags);
/** @} */

/** \name RoboSense
 * @{ */
std::string rs16Packet(const TurningPacket& packet);
/** Of RS-LiDAR-32 the same, with other angles in its device packet. */
std::string heliosPacket(const TurningPacket& packet);
std::string airyPacket(const TurningPacket& packet);
std::string airyImuPacket(std::int64_t stamp_ns, const std::vector<std::int32_t>& values);
std::string m1Packet(std::int64_t stamp_ns, std::uint16_t number);

/** \param elevations of the beams [deg] \param unit_deg of the sensor's table
 * \param room beams that its tables have room for */
std::string devicePacket(
    const std::vector<double>& elevations, double unit_deg, std::size_t room,
    std::uint8_t returns = 4);
/** Of an RS-LiDAR-16, whose table is another one. */
std::string device16Packet(const std::vector<double>& elevations, std::uint8_t returns);
/** @} */

}  // namespace fastlio::testing
