// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_container.h An MCAP file that is being written: chunks, their indexes, the summary. */
#pragma once

#include <fastlio/files/atomic_file.h>

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace fastlio
{
/** Each topic is a channel of one type of ROS 2; chunks are compressed with Zstandard. */
class McapContainer
{
 public:
  /** \exception std::runtime_error the file cannot be opened */
  explicit McapContainer(const std::string& path);

  /** \param type of ROS 2, one that ros2DefinitionOf() knows \param data CDR
   * \exception std::runtime_error the disk refused it */
  void message(
      const std::string& topic, const std::string& type, std::int64_t stamp_ns,
      const std::string& data);

  OutputFile commit();

 private:
  struct IndexEntry
  {
    std::uint64_t stamp = 0, offset = 0;
  };

  void put(const std::string& bytes);
  std::uint16_t channelOf(const std::string& topic, const std::string& type);
  void closeChunk();
  [[nodiscard]] std::string statistics() const;

  AtomicFile file_;
  std::uint64_t position_ = 0;
  std::map<std::string, std::uint16_t> channels_;  // by topic
  std::string definitions_;                        // the records of all channels
  std::map<std::uint16_t, std::uint64_t> counts_;  // by channel
  std::string chunk_;
  std::map<std::uint16_t, std::vector<IndexEntry>> index_;                      // of the chunk
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max(), last_ = 0;  // of the chunk
  std::uint64_t begin_ = std::numeric_limits<std::uint64_t>::max(), end_ = 0;   // of the file
  std::string chunk_indexes_;
  std::uint32_t chunks_ = 0;
};

}  // namespace fastlio
