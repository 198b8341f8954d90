// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_sensor.h Packets of one sensor to observations: one class per maker. */
#pragma once

#include <fastlio/recordings/packet_streams.h>

#include <memory>
#include <string>

namespace fastlio
{
/** Collects the packets of a scan, and gives it when it is complete. */
class PacketSensor
{
 public:
  PacketSensor() = default;
  virtual ~PacketSensor() = default;
  PacketSensor(const PacketSensor&) = delete;
  PacketSensor& operator=(const PacketSensor&) = delete;

  /** A packet that the sensor's kind was recognised by, or another one of that size. */
  virtual void take(const UdpPacket& packet, ObservationQueue& out) = 0;

  /** The observations left at the end. */
  virtual void flush(ObservationQueue& out) = 0;
};

/** \name By maker. The functions that recognise look at the packet alone.
 * @{ */
[[nodiscard]] std::unique_ptr<PacketSensor> makeVelodyneSensor(const std::string& label);

[[nodiscard]] bool isLivoxPacket(const UdpPacket& packet);
[[nodiscard]] bool isLivoxImu(const UdpPacket& packet);
[[nodiscard]] std::unique_ptr<PacketSensor> makeLivoxSensor(const std::string& label);
/** @} */

}  // namespace fastlio
