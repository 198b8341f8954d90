// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "packet_kinds.h"
#include <fastlio/options/printable.h>
#include <fastlio/packets/ouster_sensor.h>
#include <fastlio/packets/packet_streams.h>

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

std::string velodyneContent(const UdpPacket& /*packet*/)
{
  return "LiDAR, raw packets";
}

std::string livoxContent(const UdpPacket& packet)
{
  return isLivoxImu(packet) ? "IMU" : "LiDAR, scans of 0.1 s";
}

std::string hesaiContent(const UdpPacket& /*packet*/)
{
  return "LiDAR";
}

/** A row: a maker whose packets are recognised by their content. */
struct PacketMaker
{
  const char* name;
  const char* kind;  //!< the address of the sender follows
  bool (*recognises)(const UdpPacket&);
  std::string (*content)(const UdpPacket&);  //!< for people
  std::unique_ptr<PacketSensor> (*make)(const std::string& label, const Sidecars&);
};

constexpr std::array<PacketMaker, 4> kMakers{{
    {"Velodyne", "velodyne_", isVelodynePacket, velodyneContent, makeVelodyneSensor},
    {"Livox", "livox_", isLivoxPacket, livoxContent, makeLivoxSensor},
    {"Hesai", "hesai_", isHesaiPacket, hesaiContent, makeHesaiSensor},
    {"RoboSense", "robosense_", isRoboSensePacket, robosenseContent, makeRoboSenseSensor},
}};
}  // namespace

PacketStreams::PacketStreams(const std::string& metadata) : files_(std::make_unique<Sidecars>())
{
  if (metadata.empty())
    files_->ouster_trouble = "the sensor's metadata is not given";
  else
    files_->ouster = std::make_unique<OusterMetadata>(parseOusterMetadata(metadata));
}

PacketStreams PacketStreams::ofCapture(const std::string& path, PacketLabels labels)
{
  PacketStreams streams;
  streams.labels_ = labels;
  Sidecars& files = *streams.files_;
  files.hesai_angles = hesaiAnglesBeside(path);
  files.ouster_trouble =
      "put the sensor's metadata beside the recording, under its name with the ending .json";
  try
  {
    if (auto metadata = ousterMetadataBeside(path))
      files.ouster = std::make_unique<OusterMetadata>(std::move(*metadata));
  }
  catch (const std::runtime_error& e)
  {
    files.ouster_trouble = e.what();
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
  stream.sensor->take(packet, out);
  note(*stream.sensor);
  ++stream.taken;
}

const std::string& PacketStreams::labelOf(const std::string& name, const UdpPacket& packet) const
{
  return labels_ == PacketLabels::Source ? packet.source : name;
}

void PacketStreams::note(PacketSensor& sensor)
{
  if (std::string problem = sensor.takeProblem(); !problem.empty())
    problems_.push_back(std::move(problem));
}

void PacketStreams::flush(ObservationQueue& out)
{
  for (const auto& [label, sensor] : sensors_)
  {
    sensor->flush(out);
    note(*sensor);
  }
}

void PacketStreams::recognise(const UdpPacket& packet, Stream& stream)
{
  const auto* const maker = std::find_if(
      kMakers.begin(), kMakers.end(),
      [&packet](const PacketMaker& row) { return row.recognises(packet); });
  if (maker == kMakers.end())
  {
    recogniseOuster(packet, stream);
    return;
  }
  const std::string name = maker->kind + packet.source;
  auto& sensor = sensors_[name];
  if (!sensor) sensor = maker->make(labelOf(name, packet), *files_);
  stream.type = maker->name;
  stream.reason = maker->content(packet);
  stream.sensor = sensor.get();
}

void PacketStreams::recogniseOuster(const UdpPacket& packet, Stream& stream)
{
  const auto& ouster = files_->ouster;
  const bool imu = ouster && ouster->isImuSize(packet.size);
  if (ouster && (packet.size == ouster->packetBytes() ||
                 (imu && (ouster->imu_port == 0 || ouster->imu_port == packet.port))))
  {
    const std::string name = "ouster_" + packet.source;
    auto& sensor = sensors_[name];
    if (!sensor) sensor = std::make_unique<OusterSensor>(*ouster, labelOf(name, packet));
    stream.type = "Ouster";
    stream.reason = imu ? "IMU, converted to rad/s and m/s^2" : "LiDAR";
    stream.sensor = sensor.get();
    return;
  }
  const bool first = stream.reason.empty();
  stream.reason = "not read: no LiDAR that this program knows";
  if (ouster && !ouster->unread_imu.empty() && ouster->imu_port == packet.port)
    stream.reason = "not read: inertial packets of an Ouster, of the profile '" +
                    printable(ouster->unread_imu) + "', which is not known";
  if (!maybeOuster(packet.size)) return;
  const std::string why =
      ouster ? "the metadata ask for packets of " + std::to_string(ouster->packetBytes()) + " bytes"
             : files_->ouster_trouble;
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
