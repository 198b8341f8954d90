// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_kinds.h The kinds of sensors that are recognised by their packets: one class per
 * maker. */
#pragma once

#include "hesai_models.h"
#include <fastlio/packets/ouster_metadata.h>
#include <fastlio/packets/packet_sensor.h>

#include <memory>
#include <optional>
#include <string>

namespace fastlio
{
/** Files beside a capture that describe its sensors. */
struct Sidecars
{
  std::unique_ptr<OusterMetadata> ouster;
  std::string ouster_trouble;  //!< why there is no metadata
  std::optional<HesaiBeams> hesai_angles;
};

/** \name By maker. The functions that recognise look at the packet alone.
 * @{ */
[[nodiscard]] std::unique_ptr<PacketSensor> makeVelodyneSensor(
    const std::string& label, const Sidecars&);

[[nodiscard]] bool isLivoxPacket(const UdpPacket& packet);
[[nodiscard]] bool isLivoxImu(const UdpPacket& packet);
[[nodiscard]] std::unique_ptr<PacketSensor> makeLivoxSensor(
    const std::string& label, const Sidecars&);

[[nodiscard]] bool isHesaiPacket(const UdpPacket& packet);
[[nodiscard]] std::unique_ptr<PacketSensor> makeHesaiSensor(
    const std::string& label, const Sidecars& files);

[[nodiscard]] bool isRoboSensePacket(const UdpPacket& packet);
/** For people. */
[[nodiscard]] std::string robosenseContent(const UdpPacket& packet);
[[nodiscard]] std::unique_ptr<PacketSensor> makeRoboSenseSensor(
    const std::string& label, const Sidecars&);
/** @} */

}  // namespace fastlio
