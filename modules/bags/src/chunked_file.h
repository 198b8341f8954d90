// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file chunked_file.h What bags of ROS 1 and MCAP have in common: records, most of them in chunks
 * that may be compressed. */
#pragma once

#include "ros_message_source.h"

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace fastlio
{
/** What the formats differ in, as far as reading of chunks is concerned. */
struct ChunkedFormat
{
  const char* name;                //!< of the format, in messages
  std::uint64_t first_record;      //!< its place in the file
  const char* known_compressions;  //!< in messages
  /** By name; null: the bytes are as they are. */
  std::vector<std::pair<std::string_view, std::unique_ptr<Inflater> (*)()>> compressions;
  /** The place of the next chunk from a place on; see chunk_search.h. */
  std::optional<std::uint64_t> (*find_chunk)(FileBytes& file, std::uint64_t from);
};

/** Reads from the front. What can be read of a damaged or cut file is read: behind damage, reading
 * goes on with the next chunk. */
class ChunkedFile : public RosMessageSource
{
 public:
  [[nodiscard]] NextMessage next(const TopicFilter& wanted) override;
  [[nodiscard]] std::uint64_t position() const override { return file_.position(); }
  [[nodiscard]] bool listsAllTopics() const override { return lists_topics_; }

 protected:
  /** The outcome of reading a record. */
  enum class Step
  {
    Message,   //!< one is in message_
    Other,     //!< there may be more
    Ended,     //!< the bytes have ended, between two records or in one
    Finished,  //!< the part of the file that holds data is over
    Broken     //!< nothing behind can be understood
  };

  /** \param shown_name the name of the file in messages \param format must outlive it
   * \exception std::runtime_error it cannot be opened */
  ChunkedFile(const std::string& path, std::string shown_name, const ChunkedFormat& format);

  virtual Step readRecord(ByteSource& source, const TopicFilter& wanted) = 0;

  /** Reads the list of topics at the end of the file. Afterwards the file is at its first record.
   * \param place nothing: there is no list */
  void readList(std::optional<std::uint64_t> place);
  Step readMessage(
      ByteSource& source, const RosTopic& topic, std::size_t size, const TopicFilter& wanted);
  /** At the first byte of its data. \param size of these in the file \param checksum 0: not known
   */
  Step openChunk(std::string_view compression, std::uint64_t size, std::uint32_t checksum = 0);

  [[nodiscard]] bool isInChunk() const { return chunk_.bytes != nullptr; }
  /** Where the record of the file at hand, or the chunk around it, begins. */
  [[nodiscard]] std::uint64_t recordPlace() const { return record_; }

  FileBytes file_;
  Bytes data_;  //!< of the record at hand

 private:
  struct Chunk
  {
    std::unique_ptr<StretchBytes> bytes;
    std::uint64_t end = 0;
    std::uint32_t checksum = 0;          // zero: not known
    std::optional<std::string> refused;  // its compression, which is not known
  };

  [[nodiscard]] ReadProblem problem(ReadProblemKind kind, const std::string& what) const;
  [[nodiscard]] std::optional<ReadProblem> closeChunk(Step step);
  [[nodiscard]] ReadProblem endOfFile(Step step);

  std::string shown_name_;
  const ChunkedFormat& format_;
  Chunk chunk_;  // the one at hand
  std::uint64_t record_ = 0;
  RosMessage message_;
  std::size_t searches_ = 0;  // for a chunk behind damage
  bool lists_topics_ = false, finished_ = false;
};

}  // namespace fastlio
