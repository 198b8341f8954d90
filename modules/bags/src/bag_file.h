// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bag_file.h ROS 1 bags, version 2.0: http://wiki.ros.org/Bags/Format/2.0 */
#pragma once

#include "bag_fields.h"
#include "ros_recording.h"

namespace fastlio
{
/** Reads from the front, without the index: an index may be missing, or damaged like the rest. What
 * can be read of a damaged or cut bag is read. */
class BagFile : public RosMessageSource
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit BagFile(const std::string& path);

  [[nodiscard]] NextMessage next(const TopicFilter& wanted) override;
  [[nodiscard]] std::uint64_t position() const override { return file_.position(); }
  [[nodiscard]] std::vector<const RosTopic*> topics() const override;
  [[nodiscard]] bool listsAllTopics() const override { return lists_topics_; }

 private:
  /** The outcome of reading a record. */
  enum class Step
  {
    Message,  //!< one is in message_
    Other,    //!< there may be more
    End,
    Broken  //!< nothing behind can be understood
  };

  void readIndex();
  Step readRecord(ByteSource& source, const TopicFilter& wanted);
  Step readMessage(
      ByteSource& source, const BagFields& fields, std::size_t size, const TopicFilter& wanted);
  Step readConnection(ByteSource& source, const BagFields& fields, std::size_t size);
  Step openChunk(const BagFields& fields, std::size_t size);
  [[nodiscard]] std::optional<ReadProblem> closeChunk(Step step);
  [[nodiscard]] NextMessage endOfFile(Step step);

  std::string path_;
  FileBytes file_;
  std::unique_ptr<StretchBytes> chunk_;  // the one at hand
  std::uint64_t record_ = 0;             // where the record of the file at hand begins
  std::uint64_t chunk_end_ = 0;
  std::map<std::uint32_t, RosTopic> connections_;
  Bytes head_, data_;
  RosMessage message_;
  std::string refused_;       // a compression that is not known
  std::size_t searches_ = 0;  // for a chunk behind damage
  bool lists_topics_ = false, finished_ = false;
};

[[nodiscard]] bool isBag(const std::string& path);

}  // namespace fastlio
