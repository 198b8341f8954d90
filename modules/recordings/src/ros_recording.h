// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros_recording.h Observations out of the messages of ROS, whatever holds them. */
#pragma once

#include "byte_source.h"
#include "ouster_topics.h"
#include "packet_topics.h"
#include "transform_tree.h"
#include "wire_reader.h"
#include <fastlio/recordings/recording_reader.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
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
};

/** Opens the container anew. */
using OpenMessages = std::function<std::unique_ptr<RosMessageSource>()>;

/** A recording of ROS messages. Its beginning is looked through for the transforms between the
 * frames of the sensors, and for metadata, before the first observation is given. */
class RosRecording : public RecordingReader
{
 public:
  /** \exception std::runtime_error the container cannot be opened */
  RosRecording(std::string path, OpenMessages open);

  [[nodiscard]] NextRecorded next() override;
  [[nodiscard]] std::uint64_t position() const override { return messages_->position(); }
  [[nodiscard]] std::vector<TopicReport> topics() const override;
  [[nodiscard]] std::vector<std::string> notes() const override;

 private:
  struct Counts
  {
    std::size_t messages = 0, taken = 0;
  };

  void lookAhead();
  void lookAt(const RosMessage& message);
  [[nodiscard]] std::optional<ReadProblem> convert(const RosMessage& message);
  [[nodiscard]] ReadProblem problemOf(const RosMessage& message, const std::string& what) const;
  void takePackets(const RosTopic& topic, PacketMessage kind, WireReader& in);
  void setPose(mrpt::obs::CObservation& observation, const std::string& frame);

  std::string path_;
  OpenMessages open_;
  std::unique_ptr<RosMessageSource> messages_;
  TransformTree transforms_;
  OusterTopics ouster_;
  PacketTopics packets_;
  ObservationQueue queue_;                     // read, and not given yet
  std::string vehicle_;                        // the frame that poses refer to; empty: none known
  std::map<std::string, std::string> frames_;  // by label: the frame and what is known of its pose
  std::map<std::string, Counts> counts_;       // by topic
  std::set<std::string> refused_;              // topics whose trouble has been reported
  std::size_t index_ = 0;                      // of the message at hand
};

}  // namespace fastlio
