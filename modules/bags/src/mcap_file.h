// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_file.h MCAP files with messages of ROS 1 or ROS 2: https://mcap.dev/spec */
#pragma once

#include "mcap_chunks.h"
#include "mcap_definitions.h"
#include "ros_recording.h"

namespace fastlio
{
/** Reads from the front; of the summary at the end the channels are used, where it is there, and
 * which chunks hold them. What can be read of a damaged or cut file is read. */
class McapFile : public RosMessageSource
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit McapFile(const std::string& path);
  /** \param shown_name the name of the file in messages */
  McapFile(const std::string& path, std::string shown_name);

  [[nodiscard]] NextMessage next(const TopicFilter& wanted) override;
  [[nodiscard]] std::uint64_t position() const override { return file_.position(); }
  [[nodiscard]] std::vector<const RosTopic*> topics() const override
  {
    return definitions_.topics();
  }
  [[nodiscard]] bool listsAllTopics() const override { return lists_topics_; }
  void leaveOutUnwanted() override { leave_out_ = true; }

 private:
  enum class Step
  {
    Message,   //!< one is in message_
    Other,     //!< there may be more
    Ended,     //!< the bytes have ended, between two records or in one
    Finished,  //!< the part of the file that holds data is over
    Broken     //!< nothing behind can be understood
  };

  void readSummary();
  Step readRecord(ByteSource& source, const TopicFilter& wanted);
  Step readMessage(ByteSource& source, std::uint64_t size, const TopicFilter& wanted);
  Step readDefinition(std::uint8_t op, ByteSource& source, std::uint64_t size);
  Step openChunk(std::uint64_t size, const TopicFilter& wanted);
  [[nodiscard]] bool isLeftOut(const TopicFilter& wanted) const;
  [[nodiscard]] std::optional<ReadProblem> closeChunk(Step step);
  [[nodiscard]] ReadProblem endOfFile(Step step);

  /** The chunk at hand. */
  struct Chunk
  {
    std::unique_ptr<StretchBytes> bytes;
    std::uint64_t end = 0;
    std::uint32_t checksum = 0;  // zero: not known
    std::string refused;         // its compression, which is not known
  };

  std::string shown_name_;
  FileBytes file_;
  Chunk chunk_;
  std::uint64_t record_ = 0;  // where the record of the file at hand begins
  McapDefinitions definitions_;
  Bytes data_;
  RosMessage message_;
  std::size_t searches_ = 0;  // for a chunk behind damage
  McapChunks chunks_;
  bool lists_topics_ = false, leave_out_ = false, finished_ = false;
};

[[nodiscard]] bool isMcap(const std::string& path);

/** The first bytes of every such file. */
[[nodiscard]] const std::string& mcapMagic();

}  // namespace fastlio
