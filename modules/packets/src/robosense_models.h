// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file robosense_models.h How RoboSense's turning LiDARs lay out their packets (MSOP), and what
 * their device packets (DIFOP) tell of their beams. */
#pragma once

#include <fastlio/packets/packet_streams.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
/** Types of packets. */
enum class RoboSensePacket
{
  Rs16Or32,  //!< points of an RS-LiDAR-16 or -32: the device packet says which
  Helios,    //!< points of a Helios with 32 lines
  Airy,      //!< points of an Airy
  AiryImu,
  M1,      //!< points of an M1, which does not turn
  Device,  //!< DIFOP of those that turn
  Other,   //!< of RoboSense, and not needed
};

/** Nothing: it is no packet of RoboSense, or of a model that is not read. */
[[nodiscard]] std::optional<RoboSensePacket> robosensePacketOf(const UdpPacket& packet);

/** Beams and firing of one sensor. */
struct RoboSenseLayout
{
  std::size_t blocks = 12, channels = 32;  //!< in a packet, in a block
  double range_unit = 5e-3;                //!< [m]
  std::uint16_t range_mask = 0xFFFF;
  double step_ns = 0;                       //!< from block to block, where the azimuth differs
  double lens_radius = 0, lens_height = 0;  //!< where the beams leave [m]
  bool stamp_is_date = false;               //!< otherwise seconds since 1970
  std::vector<double> elevation, azimuth;   //!< of each beam [rad]
  std::vector<double> time_ns;              //!< of each channel, after the block
  std::size_t beams = 0;                    //!< channel i is of beam i % beams

  [[nodiscard]] std::size_t blockBytes() const { return 4 + 3 * channels; }
};

/** The first block begins here, in every packet of points. */
inline constexpr std::size_t kRoboSenseHead = 42;

/** \param points the type of its packets of points: Rs16Or32, Helios or Airy
 * \param mode byte of the head with the number of lines, of an Airy
 * \param device a packet of type Device
 * \return nothing: the device packet has no angles */
[[nodiscard]] std::optional<RoboSenseLayout> robosenseLayoutOf(
    RoboSensePacket points, std::uint8_t mode, const std::vector<std::uint8_t>& device);

}  // namespace fastlio
