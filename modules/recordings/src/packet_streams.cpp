// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ouster_sensor.h"
#include "packet_sensor.h"
#include <fastlio/recordings/packet_streams.h>

#include <algorithm>
#include <array>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostStreams = 10'000;
constexpr std::size_t kMostSensors = 64;  // each holds a scan
constexpr std::size_t kLooks = 20;        // packets of a stream before it counts as something else

/** Sizes that Ouster's packets of 16 columns have, for a hint where the metadata is missing. */
bool maybeOuster(std::size_t size)
{
  constexpr std::array<std::size_t, 4> kLegacy{3392, 6464, 12608, 24896};
  if (std::find(kLegacy.begin(), kLegacy.end(), size) != kLegacy.end()) return true;
  constexpr std::size_t kHeads = 64 + 16 * 12;
  for (const std::size_t beams : {16U, 32U, 64U, 128U})
    for (const std::size_t pixel : {4U, 8U, 12U, 16U})
      if (size == kHeads + 16 * beams * pixel) return true;
  return false;
}
}  // namespace

PacketStreams::PacketStreams(const std::string& metadata)
{
  if (metadata.empty())
    ouster_trouble_ = "the sensor's metadata is not given";
  else
    ouster_ = std::make_unique<OusterMetadata>(parseOusterMetadata(metadata));
}

PacketStreams PacketStreams::ofCapture(const std::string& path)
{
  PacketStreams streams;
  streams.ouster_trouble_ =
      "put the sensor's metadata beside the capture, with its name and .json instead of .pcap";
  try
  {
    if (auto metadata = ousterMetadataBeside(path))
      streams.ouster_ = std::make_unique<OusterMetadata>(std::move(*metadata));
  }
  catch (const std::runtime_error& e)
  {
    streams.ouster_trouble_ = e.what();
  }
  return streams;
}

PacketStreams::~PacketStreams() = default;
PacketStreams::PacketStreams(PacketStreams&&) noexcept = default;
PacketStreams& PacketStreams::operator=(PacketStreams&&) noexcept = default;

void PacketStreams::take(const UdpPacket& packet, ObservationQueue& out)
{
  const auto key = std::make_pair(packet.source, packet.port);
  if (streams_.size() >= kMostStreams && streams_.count(key) == 0) return;
  Stream& stream = streams_[key];
  ++stream.packets;
  const bool room = sensors_.size() < kMostSensors;
  if (stream.sensor == nullptr && stream.packets <= kLooks && packet.size > 0 && room)
    recognise(packet, stream);
  if (stream.sensor == nullptr) return;
  if (stream.type == "Velodyne" && !isVelodynePacket(packet)) return;
  stream.sensor->take(packet, out);
  ++stream.taken;
}

void PacketStreams::flush(ObservationQueue& out)
{
  for (const auto& [label, sensor] : sensors_)
    sensor->flush(out);
}

PacketSensor* PacketStreams::sensorOf(
    const std::string& label, std::unique_ptr<PacketSensor> (*make)(const std::string&))
{
  auto& sensor = sensors_[label];
  if (!sensor) sensor = make(label);
  return sensor.get();
}

void PacketStreams::recognise(const UdpPacket& packet, Stream& stream)
{
  if (isVelodynePacket(packet))
  {
    stream.type = "Velodyne";
    stream.reason = "LiDAR, raw packets";
    stream.sensor = sensorOf("velodyne_" + packet.source, makeVelodyneSensor);
  }
  else if (isLivoxPacket(packet))
  {
    stream.type = "Livox";
    stream.reason = isLivoxImu(packet) ? "IMU" : "LiDAR, scans of 0.1 s";
    stream.sensor = sensorOf("livox_" + packet.source, makeLivoxSensor);
  }
  else
    recogniseOuster(packet, stream);
}

void PacketStreams::recogniseOuster(const UdpPacket& packet, Stream& stream)
{
  const bool imu = packet.size == kOusterImuBytes;
  if (ouster_ && (packet.size == ouster_->packetBytes() ||
                  (imu && (ouster_->imu_port == 0 || ouster_->imu_port == packet.port))))
  {
    const std::string label = "ouster_" + packet.source;
    auto& sensor = sensors_[label];
    if (!sensor) sensor = std::make_unique<OusterSensor>(*ouster_, label);
    stream.type = "Ouster";
    stream.reason = imu ? "IMU, converted to rad/s and m/s^2" : "LiDAR";
    stream.sensor = sensor.get();
    return;
  }
  const bool first = stream.reason.empty();
  stream.reason = "not read: no LiDAR that this program knows";
  if (!maybeOuster(packet.size)) return;
  const std::string why = ouster_ ? "the metadata ask for packets of " +
                                        std::to_string(ouster_->packetBytes()) + " bytes"
                                  : ouster_trouble_;
  stream.reason = "not read: packets of an Ouster, it seems; " + why;
  if (first)
    problems_.push_back(
        "packets of " + std::to_string(packet.size) + " bytes from " + packet.source +
        " are those of an Ouster, it seems; " + why + ".");
}

std::vector<TopicReport> PacketStreams::reports() const
{
  std::vector<TopicReport> reports;
  for (const auto& [key, stream] : streams_)
    reports.push_back(
        {key.first + " to port " + std::to_string(key.second),
         stream.type.empty() ? "UDP" : stream.type, stream.packets, stream.taken, stream.reason});
  return reports;
}

}  // namespace fastlio
