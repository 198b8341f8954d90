// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_definitions.h"

#include <stdexcept>
#include <utility>

namespace fastlio
{
bool McapDefinitions::addSchema(const Bytes& record)
try
{
  WireReader in(record.data(), record.size(), WireFormat::Ros1);
  const auto id = in.number<std::uint16_t>();
  schemas_[id] = in.text();
  return true;
}
catch (const std::runtime_error&)
{
  return false;
}

bool McapDefinitions::addChannel(const Bytes& record)
try
{
  WireReader in(record.data(), record.size(), WireFormat::Ros1);
  const auto id = in.number<std::uint16_t>();
  const auto schema = schemas_.find(in.number<std::uint16_t>());
  RosTopic topic;
  topic.name = in.text();
  const std::string encoding(in.text());
  topic.format = encoding == "ros1" ? WireFormat::Ros1 : WireFormat::Cdr;
  if (encoding != "ros1" && encoding != "cdr")
    topic.trouble = "the encoding '" + encoding + "' is not known (ros1 and cdr are)";
  if (schema != schemas_.end()) topic.type = schema->second;
  // A message may point to the first one that was defined.
  const auto known = channels_.find(id);
  if (known == channels_.end() || known->second.type.empty()) channels_[id] = std::move(topic);
  return true;
}
catch (const std::runtime_error&)
{
  return false;
}

const RosTopic& McapDefinitions::channel(std::uint16_t id)
{
  RosTopic& topic = channels_[id];
  if (topic.name.empty())
    topic = {
        "channel " + std::to_string(id), "", WireFormat::Cdr,
        "no remaining record holds its topic and type"};
  return topic;
}

const RosTopic* McapDefinitions::find(std::uint16_t id) const
{
  const auto found = channels_.find(id);
  return found == channels_.end() ? nullptr : &found->second;
}

std::vector<const RosTopic*> McapDefinitions::topics() const
{
  std::vector<const RosTopic*> topics;
  for (const auto& [id, topic] : channels_)
    topics.push_back(&topic);
  return topics;
}

}  // namespace fastlio
