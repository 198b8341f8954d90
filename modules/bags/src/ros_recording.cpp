// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ros_recording.h"

#include "look_ahead.h"
#include <fastlio/messages/ros_types.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/sensors/conversions.h>

#include <new>
#include <string_view>
#include <utility>

namespace fastlio
{
namespace
{
bool isWanted(const RosTopic& topic)
{
  return topic.trouble.empty() && rosTypeOf(topic.type).isTaken();
}
}  // namespace

RosRecording::RosRecording(std::string path, const OpenMessages& open)
    : path_(std::move(path)), packets_(path_)
{
  LookAhead ahead(transforms_, ouster_);
  messages_ = open();
  ahead.lookThrough(*messages_);
  vehicle_ = ahead.vehicleFrame();
  messages_ = open();
}

NextRecorded RosRecording::next()
{
  for (;;)
  {
    if (auto lost = problemOfPackets()) return std::move(*lost);
    if (!queue_.empty())
    {
      auto observation = std::move(queue_.front());
      queue_.pop_front();
      return observation;
    }
    NextMessage next = messages_->next(isWanted);
    if (auto* problem = std::get_if<ReadProblem>(&next)) return std::move(*problem);
    if (std::holds_alternative<EndOfRecording>(next))
    {
      ouster_.flush(queue_);
      packets_.flush();
      queuePackets();
      if (auto lost = problemOfPackets()) return std::move(*lost);
      if (queue_.empty()) return EndOfRecording{};
      continue;
    }
    const auto& message = std::get<RosMessage>(next);
    ++index_;
    ++counts_[message.topic->name].messages;
    if (message.data != nullptr)
    {
      if (auto broken = convert(message)) return std::move(*broken);
      continue;
    }
    const bool lost = !message.topic->trouble.empty() &&
                      (message.topic->type.empty() || rosTypeOf(message.topic->type).isTaken());
    if (lost && refused_.insert(message.topic->name).second)
    {
      ReadProblem problem = problemOf(message, message.topic->trouble);
      problem.kind = ReadProblemKind::NotSupported;
      return problem;
    }
  }
}

// Its observations are in the queue then.
std::optional<ReadProblem> RosRecording::convert(const RosMessage& message)
{
  const RosTopic& topic = *message.topic;
  try
  {
    const InflatedMessage data(message);
    WireReader in(data.bytes().data(), data.bytes().size(), topic.format);
    const RosType& type = rosTypeOf(topic.type);
    if (type.role == RosRole::OusterPackets)
      ouster_.takePacket(topic.name, in, queue_);
    else if (type.packets)
    {
      packets_.take(topic.name, *type.packets, in);
      queuePackets();
    }
    else
    {
      RosObservation result = type.read(in, topic.name);
      setPose(*result.observation, result.frame, type.isLidarOrImu());
      queue_.push_back(std::move(result.observation));
    }
    ++counts_[topic.name].taken;
    return std::nullopt;
  }
  catch (const std::bad_alloc&)
  {
    return problemOf(message, "it asks for more memory than there is");
  }
  catch (const std::exception& e)
  {
    return problemOf(message, e.what());
  }
}

void RosRecording::queuePackets()
{
  for (RosObservation& complete : packets_.takeObservations())
  {
    setPose(*complete.observation, complete.frame, true);
    queue_.push_back(std::move(complete.observation));
  }
}

std::optional<ReadProblem> RosRecording::problemOfPackets()
{
  const auto problem = packets_.takeProblem();
  if (!problem) return std::nullopt;
  return ReadProblem{
      path_, ReadProblemKind::NotSupported, "", path_ + ": " + printable(*problem, 1000)};
}

ReadProblem RosRecording::problemOf(const RosMessage& message, const std::string& what) const
{
  const std::string& known = message.topic->type;
  const std::string type = (known.empty() ? "unknown type" : known) + " on " + message.topic->name;
  return {
      path_, ReadProblemKind::Corrupt, printable(type),
      path_ + ": message " + std::to_string(index_ - 1) + " (" + printable(type) + ") at byte " +
          std::to_string(message.offset) + ": " + printable(what, 1000) + "."};
}

// Where the beginning of the recording has not decided on the vehicle's frame, the first LiDAR or
// IMU does.
void RosRecording::setPose(
    mrpt::obs::CObservation& observation, const std::string& frame, bool is_lidar_or_imu)
{
  const auto known = frames_.find(observation.sensorLabel);
  const std::string vehicle =
      vehicle_.empty() ? transforms_.vehicleFrameOf({frame}).value_or("") : vehicle_;
  if (is_lidar_or_imu) vehicle_ = vehicle;
  std::optional<Pose> pose;
  if (!vehicle.empty()) pose = transforms_.poseOf(frame, vehicle);
  if (pose) observation.setSensorPose(toMrptPose(*pose));
  if (known != frames_.end()) return;
  frames_[observation.sensorLabel] =
      "'" + printable(frame) + "'" +
      (pose ? ", pose in '" + printable(vehicle) + "' " + poseText(*pose, 6) + " by tf"
            : ", no pose is recorded");
}

std::vector<TopicReport> RosRecording::topics() const
{
  std::vector<TopicReport> reports;
  std::set<std::string_view> seen;
  for (const RosTopic* topic : messages_->topics())
  {
    if (!seen.insert(topic->name).second) continue;
    TopicReport report{topic->name, topic->type, 0, 0, rosTypeOf(topic->type).meaning};
    if (!topic->trouble.empty()) report.reason = "not read: " + topic->trouble;
    if (const auto counts = counts_.find(topic->name); counts != counts_.end())
    {
      report.messages = counts->second.messages;
      report.taken = counts->second.taken;
    }
    if (const auto frame = frames_.find(topic->name); frame != frames_.end())
      report.reason += "; frame " + frame->second;
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<std::string> RosRecording::notes() const
{
  std::vector<std::string> notes;
  for (const auto& [label, text] : frames_)
    notes.push_back("'" + printable(label) + "': frame " + text + ".");
  return notes;
}

}  // namespace fastlio
