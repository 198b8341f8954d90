// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros_recording.h Observations out of the messages of ROS, whatever holds them. */
#pragma once

#include "ros_message_source.h"
#include <fastlio/messages/ouster_topics.h>
#include <fastlio/messages/packet_topics.h>
#include <fastlio/messages/transform_tree.h>
#include <fastlio/recordings/recording_reader.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fastlio
{
/** Opens the container anew. */
using OpenMessages = std::function<std::unique_ptr<RosMessageSource>()>;

/** A recording of ROS messages. Its beginning is looked through for the transforms between the
 * frames of the sensors, and for metadata, before the first observation is given. */
class RosRecording : public RecordingReader
{
 public:
  /** \exception std::runtime_error the container cannot be opened */
  RosRecording(std::string path, const OpenMessages& open);

  [[nodiscard]] NextRecorded next() override;
  [[nodiscard]] std::uint64_t position() const override { return messages_->position(); }
  [[nodiscard]] std::vector<TopicReport> topics() const override;
  [[nodiscard]] std::vector<std::string> notes() const override;

 private:
  struct Counts
  {
    std::size_t messages = 0, taken = 0;
  };

  [[nodiscard]] std::optional<ReadProblem> convert(const RosMessage& message);
  [[nodiscard]] ReadProblem problemOf(const RosMessage& message, const std::string& what) const;
  [[nodiscard]] std::optional<ReadProblem> problemOfPackets();
  void queuePackets();
  void setPose(
      mrpt::obs::CObservation& observation, const std::string& frame, bool is_lidar_or_imu);

  std::string path_;
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
