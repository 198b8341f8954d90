// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros_message_source.h The messages of ROS in whatever holds them. */
#pragma once

#include <fastlio/messages/wire_reader.h>
#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/recording_reader.h>

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** A topic as the container describes it. */
struct RosTopic
{
  std::string name, type;
  WireFormat format = WireFormat::Ros1;
  std::string trouble;  //!< why its messages cannot be read; empty: nothing is known against it
};

/** One message; its bytes stay valid until the next one. */
struct RosMessage
{
  const RosTopic* topic = nullptr;
  const Bytes* data = nullptr;  //!< null: nobody wanted it
  std::uint64_t offset = 0;     //!< where it, or the chunk around it, starts in the file
};

using NextMessage = std::variant<RosMessage, ReadProblem, EndOfRecording>;

/** The bytes of a message, inflated where the message is compressed by itself. */
class InflatedMessage
{
 public:
  /** \param message has data, which must outlive it
   * \exception std::runtime_error they are damaged, or larger than kLargestRecord */
  explicit InflatedMessage(const RosMessage& message);

  [[nodiscard]] const Bytes& bytes() const { return own_.empty() ? packed_ : own_; }

 private:
  const Bytes& packed_;
  Bytes own_;
};

/** Whether messages of a topic are worth being loaded. */
using TopicFilter = std::function<bool(const RosTopic&)>;

/** The messages of a bag in the order of the file. Never throws for what the file holds. */
class RosMessageSource
{
 public:
  RosMessageSource() = default;
  virtual ~RosMessageSource() = default;
  RosMessageSource(const RosMessageSource&) = delete;
  RosMessageSource& operator=(const RosMessageSource&) = delete;

  [[nodiscard]] virtual NextMessage next(const TopicFilter& wanted) = 0;
  [[nodiscard]] virtual std::uint64_t position() const = 0;

  /** All topics that the container has listed so far, also those without messages. */
  [[nodiscard]] virtual std::vector<const RosTopic*> topics() const = 0;

  /** These are all that there are, also before their first messages. */
  [[nodiscard]] virtual bool listsAllTopics() const { return false; }

  /** From now on messages that nobody wants may be left out. */
  virtual void leaveOutUnwanted() {}
};

}  // namespace fastlio
