// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/packet_topics.h>
#include <fastlio/messages/ros_messages.h>

#include <stdexcept>
#include <string_view>
#include <utility>

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
  (void)readRosTime(in);
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

void PacketTopics::take(const std::string& topic, PacketMessage kind, WireReader& in)
{
  const RosHeader header = readRosHeader(in);
  frames_[topic] = header.frame;
  if (kind == PacketMessage::Single)
  {
    (void)in.take(2);
    const PacketView packet = variedPacket(in);
    takePacket(topic, packet.data, packet.size);
    return;
  }
  const bool fixed = kind == PacketMessage::Fixed;
  const std::size_t packets = in.count(kStampBytes + (fixed ? kFixedBytes + 4 : 4));
  for (std::size_t i = 0; i < packets; ++i)
  {
    if (!fixed) (void)readRosTime(in);
    const PacketView packet = fixed ? fixedPacket(in) : variedPacket(in);
    takePacket(topic, packet.data, packet.size);
  }
}

void PacketTopics::takePacket(const std::string& topic, const std::uint8_t* data, std::size_t size)
{
  // Most recordings have no such topics: the files beside them are not looked at.
  if (!streams_) streams_ = PacketStreams::ofCapture(recording_, PacketLabels::Source);
  UdpPacket packet;
  packet.source = topic;
  packet.data = data;
  packet.size = size;
  streams_->take(packet, queue_);
}

void PacketTopics::flush()
{
  if (streams_) streams_->flush(queue_);
}

std::string PacketTopics::frameOf(const std::string& label) const
{
  constexpr std::string_view kImu = "_imu";
  const auto topic = frames_.find(label);
  if (topic != frames_.end()) return topic->second;
  const bool sample = label.size() > kImu.size() &&
                      label.compare(label.size() - kImu.size(), kImu.size(), kImu) == 0;
  const auto lidar =
      sample ? frames_.find(label.substr(0, label.size() - kImu.size())) : frames_.end();
  return lidar == frames_.end() ? "" : lidar->second;
}

std::vector<RosObservation> PacketTopics::takeObservations()
{
  std::vector<RosObservation> complete;
  for (auto& observation : std::exchange(queue_, {}))
  {
    const std::string frame = frameOf(observation->sensorLabel);
    complete.push_back({std::move(observation), frame});
  }
  return complete;
}

std::optional<std::string> PacketTopics::takeProblem()
{
  if (streams_)
    for (std::string& problem : streams_->takeProblems())
      problems_.push_back(std::move(problem));
  if (problems_.empty()) return std::nullopt;
  std::string first = std::move(problems_.front());
  problems_.erase(problems_.begin());
  return first;
}

}  // namespace fastlio
