// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_sensor.h Packets of one sensor to observations: one class per maker. */
#pragma once

#include "hesai_models.h"
#include "ouster_metadata.h"
#include <fastlio/recordings/packet_streams.h>

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

  /** Why its packets cannot be read; empty: they can, or it was reported before. */
  [[nodiscard]] virtual std::string takeProblem() { return {}; }
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
