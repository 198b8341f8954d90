// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_sensor.h Packets of one sensor to observations. */
#pragma once

#include <fastlio/packets/packet_streams.h>

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

  /** A packet from the sender and to the port where the sensor was recognised; what is none of its
   * own is left alone. */
  virtual void take(const UdpPacket& packet, ObservationQueue& out) = 0;

  /** The observations left at the end. */
  virtual void flush(ObservationQueue& out) = 0;

  /** Why its packets cannot be read; empty: they can, or it was reported before. */
  [[nodiscard]] virtual std::string takeProblem() { return {}; }
};

}  // namespace fastlio
