// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Velodyne's data packets: they stay raw, a revolution an observation.

#include "packet_kinds.h"
#include <fastlio/math/little_endian.h>
#include <fastlio/packets/velodyne_scans.h>

#include <array>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kAzimuthAt = 2;              // of a packet's first block [0.01 deg]
constexpr std::size_t kMostPacketsPerScan = 4000;  // of a sensor whose azimuth never comes round

class VelodyneSensor : public PacketSensor
{
 public:
  explicit VelodyneSensor(std::string label) : label_(std::move(label)) {}

  void take(const UdpPacket& packet, ObservationQueue& out) override
  {
    if (!isVelodynePacket(packet)) return;  // its position packets
    const int azimuth = littleAt<std::uint16_t>(packet.data + kAzimuthAt);
    if (!packets_.empty() && (azimuth < azimuth_ || packets_.size() == kMostPacketsPerScan))
      flush(out);
    if (packets_.empty()) stamp_ns_ = packet.stamp_ns;
    azimuth_ = azimuth;
    std::copy_n(packet.data, kVelodynePacketBytes, packets_.emplace_back().begin());
  }

  void flush(ObservationQueue& out) override
  {
    if (packets_.empty()) return;
    std::vector<VelodynePacketBytes> bytes;
    for (const auto& packet : packets_)
      bytes.push_back(packet.data());
    out.push_back(makeVelodyneScan(bytes, label_, stamp_ns_));
    packets_.clear();
  }

 private:
  std::string label_;
  std::vector<std::array<std::uint8_t, kVelodynePacketBytes>> packets_;
  std::int64_t stamp_ns_ = 0;
  int azimuth_ = 0;
};
}  // namespace

bool isVelodynePacket(const UdpPacket& packet)
{
  return packet.size == kVelodynePacketBytes && packet.data[0] == 0xFF &&
         (packet.data[1] == 0xEE || packet.data[1] == 0xDD);
}

std::unique_ptr<PacketSensor> makeVelodyneSensor(const std::string& label, const Sidecars&)
{
  return std::make_unique<VelodyneSensor>(label);
}

}  // namespace fastlio
