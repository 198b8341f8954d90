// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ouster_sensor.h Packets of an Ouster, out of captures or of topics. */
#pragma once

#include <fastlio/packets/captured_scan.h>
#include <fastlio/packets/ouster_metadata.h>
#include <fastlio/packets/packet_sensor.h>

namespace fastlio
{
/** Points in the LiDAR's frame, as its manual computes them; poses are those in the frame of the
 * housing. Samples have the label of the LiDAR with "_imu". Stamps are the sensor's own, of both
 * kinds of packets. */
class OusterSensor : public PacketSensor
{
 public:
  OusterSensor(OusterMetadata metadata, std::string label);

  /** A packet of the LiDAR or of the IMU, by its size; others are left alone. */
  void take(const UdpPacket& packet, ObservationQueue& out) override;
  void flush(ObservationQueue& out) override { scan_.flush(out); }

  [[nodiscard]] bool isMine(const UdpPacket& packet) const;

 private:
  /** A column of a packet. */
  struct Column
  {
    std::int64_t stamp_ns = 0;
    std::size_t id = 0;
    bool valid = false;
    const std::uint8_t* pixels = nullptr;
  };

  [[nodiscard]] Column columnAt(const std::uint8_t* packet, std::size_t index) const;
  void takeImu(const UdpPacket& packet, ObservationQueue& out) const;
  void addSample(
      const std::uint8_t* stamp, const Vec3& rate, const Vec3& acceleration,
      ObservationQueue& out) const;
  void takeColumn(const Column& column, ObservationQueue& out);
  void add(std::uint32_t range_mm, std::uint8_t reflectivity, std::size_t pixel, double encoder);

  OusterMetadata metadata_;
  std::string label_;
  CapturedScan scan_;
  std::size_t last_id_ = 0;
};

}  // namespace fastlio
