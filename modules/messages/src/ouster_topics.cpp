// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/ouster_topics.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostOusters = 100;

/** "/ouster/lidar_packets" -> "/ouster". */
std::string parentOf(const std::string& topic)
{
  const std::size_t slash = topic.rfind('/');
  return slash == std::string::npos ? "" : topic.substr(0, slash);
}
}  // namespace

void OusterTopics::takeMetadata(const std::string& topic, WireReader& in)
{
  const std::string name = parentOf(topic);
  if (sensors_.count(name) != 0 || sensors_.size() >= kMostOusters) return;
  try
  {
    const std::string text(in.text());
    sensors_[name] =
        std::make_unique<OusterSensor>(parseOusterMetadata(text), name.empty() ? "ouster" : name);
  }
  catch (const std::runtime_error&)
  {
    sensors_.erase(name);  // a text about something else
  }
}

void OusterTopics::takePacket(const std::string& topic, WireReader& in, ObservationQueue& out)
{
  const auto sensor = sensors_.find(parentOf(topic));
  if (sensor == sensors_.end())
    throw std::runtime_error(
        "the metadata of the Ouster is missing: no text on " + parentOf(topic) +
        "/metadata in the first part of the recording");
  UdpPacket packet;
  packet.size = in.count(1);
  packet.data = in.take(packet.size);
  // Older drivers send one byte more.
  if (!sensor->second->isMine(packet) && packet.size > 0) --packet.size;
  if (!sensor->second->isMine(packet))
    throw std::runtime_error(
        "its packet of " + std::to_string(packet.size + 1) + " bytes is not one of the metadata's");
  sensor->second->take(packet, out);
}

void OusterTopics::flush(ObservationQueue& out)
{
  for (const auto& [name, sensor] : sensors_)
    sensor->flush(out);
}

}  // namespace fastlio
