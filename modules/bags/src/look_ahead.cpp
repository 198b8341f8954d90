// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "look_ahead.h"

#include <fastlio/messages/ros_types.h>

#include <algorithm>
#include <exception>
#include <variant>

namespace fastlio
{
namespace
{
// How much of a recording is looked through: a second or so of any vehicle. Fixed transforms are
// latched, and recorders write them first.
constexpr std::size_t kLookMessages = 5000;
constexpr std::uint64_t kLookBytes = std::uint64_t{64} << 20U;

bool isStatic(const RosTopic& topic)
{
  return topic.name.find("static") != std::string::npos;
}

/** Each of its messages names the frame of a sensor. */
bool isSensor(const RosTopic& topic)
{
  const RosType& type = rosTypeOf(topic.type);
  return topic.trouble.empty() && (type.read != nullptr || type.packets);
}

bool tellsOfOthers(const RosTopic& topic)
{
  const RosRole role = rosTypeOf(topic.type).role;
  return topic.trouble.empty() && (role == RosRole::Transforms || role == RosRole::Text);
}

/** No topic of the recording says anything of the sensors of others. */
bool hasNothing(const RosMessageSource& messages)
{
  const std::vector<const RosTopic*> topics = messages.topics();
  return messages.listsAllTopics() &&
         std::none_of(
             topics.begin(), topics.end(),
             [](const RosTopic* topic) { return tellsOfOthers(*topic); });
}
}  // namespace

void LookAhead::lookThrough(RosMessageSource& messages)
{
  if (hasNothing(messages)) return;
  messages.leaveOutUnwanted();
  const TopicFilter wanted = [this](const RosTopic& topic) { return isWanted(topic); };
  for (std::size_t i = 0; i < kLookMessages && messages.position() < kLookBytes; ++i)
  {
    const NextMessage next = messages.next(wanted);
    if (std::holds_alternative<EndOfRecording>(next)) return;
    const auto* message = std::get_if<RosMessage>(&next);
    if (message == nullptr || message->data == nullptr) continue;
    lookAt(*message);
    if (news_ && knowsEverySensor(messages)) return;
  }
}

// Of each sensor the first message: it names the frame.
bool LookAhead::isWanted(const RosTopic& topic) const
{
  return tellsOfOthers(topic) || (isSensor(topic) && frames_.count(topic.name) == 0);
}

void LookAhead::lookAt(const RosMessage& message)
{
  const RosTopic& topic = *message.topic;
  news_ = isSensor(topic) || isStatic(topic);
  try
  {
    const InflatedMessage data(message);
    WireReader in(data.bytes().data(), data.bytes().size(), topic.format);
    const RosType& type = rosTypeOf(topic.type);
    if (isSensor(topic))
      noteFrame(topic, type.packets ? readRosHeader(in).frame : type.read(in, topic.name).frame);
    else if (type.role == RosRole::Text)
      ouster_.takeMetadata(topic.name, in);
    else
      for (const RosTransform& transform : readTransforms(in))
        transforms_.add(transform, isStatic(topic));
  }
  catch (const std::exception&)
  {
    // A pose less; the run says which poses it uses.
    if (isSensor(topic)) frames_[topic.name];
  }
}

void LookAhead::noteFrame(const RosTopic& topic, const std::string& frame)
{
  frames_[topic.name] = frame;
  if (rosTypeOf(topic.type).isLidarOrImu()) carried_.push_back(frame);
}

std::string LookAhead::vehicleFrame() const
{
  return transforms_.vehicleFrameOf(carried_).value_or("");
}

bool LookAhead::knowsEverySensor(const RosMessageSource& messages) const
{
  if (!messages.listsAllTopics()) return false;
  const std::vector<const RosTopic*> topics = messages.topics();
  return std::all_of(
      topics.begin(), topics.end(),
      [this](const RosTopic* topic)
      {
        if (!topic->trouble.empty() || !rosTypeOf(topic->type).isTaken()) return true;
        const auto frame = frames_.find(topic->name);
        return frame != frames_.end() && transforms_.isFixedToVehicle(frame->second);
      });
}

}  // namespace fastlio
