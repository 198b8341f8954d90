// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/packet_topics.h>
#include <fastlio/messages/ros_messages.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kStampBytes = 8, kFixedBytes = 1500;

struct PacketView
{
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

PacketView fixedPacket(WireReader& in)
{
  (void)in.number<std::uint32_t>();
  (void)in.number<std::uint32_t>();
  const std::uint8_t* data = in.take(kFixedBytes);
  const std::size_t size = in.number<std::uint32_t>();
  if (size > kFixedBytes) throw std::runtime_error("it claims a packet of more than 1500 bytes");
  return {data, size};
}

PacketView variedPacket(WireReader& in)
{
  const std::size_t size = in.count(1);
  return {in.take(size), size};
}
}  // namespace

std::string PacketTopics::take(
    const std::string& topic, PacketMessage kind, WireReader& in, ObservationQueue& out)
{
  const RosHeader header = readRosHeader(in);
  if (kind == PacketMessage::Single)
  {
    (void)in.take(2);
    const PacketView packet = variedPacket(in);
    takePacket(topic, packet.data, packet.size);
  }
  else
  {
    const bool fixed = kind == PacketMessage::Fixed;
    const std::size_t packets = in.count(kStampBytes + (fixed ? kFixedBytes + 4 : 4));
    for (std::size_t i = 0; i < packets; ++i)
    {
      if (!fixed)
      {
        (void)in.number<std::uint32_t>();
        (void)in.number<std::uint32_t>();
      }
      const PacketView packet = fixed ? fixedPacket(in) : variedPacket(in);
      takePacket(topic, packet.data, packet.size);
    }
  }
  rename(queue_, out);
  const auto problems = streams_.takeProblems();
  if (!problems.empty()) throw std::runtime_error(problems.front());
  return header.frame;
}

void PacketTopics::takePacket(const std::string& topic, const std::uint8_t* data, std::size_t size)
{
  UdpPacket packet;
  packet.source = topic;
  packet.data = data;
  packet.size = size;
  streams_.take(packet, queue_);
}

void PacketTopics::flush(ObservationQueue& out)
{
  streams_.flush(queue_);
  rename(queue_, out);
}

// "hesai_/pandar_packets" -> "/pandar_packets": who made the sensor needs no mention there.
void PacketTopics::rename(ObservationQueue& from, ObservationQueue& to)
{
  for (auto& observation : from)
  {
    std::string& label = observation->sensorLabel;
    if (const auto slash = label.find('/'); slash != std::string::npos) label.erase(0, slash);
    to.push_back(std::move(observation));
  }
  from.clear();
}

}  // namespace fastlio
