// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_file.h MCAP files with messages of ROS 1 or ROS 2: https://mcap.dev/spec */
#pragma once

#include "chunked_file.h"
#include "mcap_chunks.h"
#include "mcap_definitions.h"

namespace fastlio
{
/** Of the summary at the end the channels are used, where it is there, and which chunks hold them.
 */
class McapFile : public ChunkedFile
{
 public:
  /** \exception std::runtime_error it cannot be opened */
  explicit McapFile(const std::string& path);
  /** \param shown_name the name of the file in messages */
  McapFile(const std::string& path, std::string shown_name);

  [[nodiscard]] std::vector<const RosTopic*> topics() const override
  {
    return definitions_.topics();
  }
  void leaveOutUnwanted() override { leave_out_ = true; }

 private:
  [[nodiscard]] std::optional<std::uint64_t> summaryPlace();
  Step readRecord(ByteSource& source, const TopicFilter& wanted) override;
  Step readMessageOf(ByteSource& source, std::uint64_t size, const TopicFilter& wanted);
  Step readDefinition(std::uint8_t op, ByteSource& source, std::uint64_t size);
  Step readChunkHead(std::uint64_t size, const TopicFilter& wanted);
  [[nodiscard]] bool isLeftOut(const TopicFilter& wanted) const;

  McapDefinitions definitions_;
  McapChunks chunks_;
  bool leave_out_ = false;
};

[[nodiscard]] bool isMcap(const std::string& path);

/** The first bytes of every such file. */
[[nodiscard]] const std::string& mcapMagic();

}  // namespace fastlio
