// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_writers.h"

#include "test_files.h"

#include <algorithm>
#include <bzlib.h>
#include <lz4frame.h>
#include <map>
#include <stdexcept>
#include <zstd.h>

namespace fastlio::testing
{
std::string lz4(const std::string& bytes)
{
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string packed(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), &preferences));
  return packed;
}

std::string bzip2(const std::string& bytes)
{
  auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 50 + 1000);
  std::string packed(size, '\0');
  std::string input = bytes;
  if (BZ2_bzBuffToBuffCompress(
          packed.data(), &size, input.data(), static_cast<unsigned>(input.size()), 9, 0, 0) !=
      BZ_OK)
    throw std::runtime_error("bzip2");
  packed.resize(size);
  return packed;
}

namespace
{
std::string word(std::uint32_t value)
{
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string bagField(const std::string& name, const std::string& value)
{
  return word(static_cast<std::uint32_t>(name.size() + 1 + value.size())) + name + "=" + value;
}

std::string bagRecord(const std::string& head, const std::string& data)
{
  return word(static_cast<std::uint32_t>(head.size())) + head +
         word(static_cast<std::uint32_t>(data.size())) + data;
}

std::string connection(std::uint32_t number, const TopicMessage& message)
{
  return bagRecord(
      bagField("conn", word(number)) + bagField("op", "\x07") + bagField("topic", message.topic),
      bagField("topic", message.topic) + bagField("type", message.type) +
          bagField("md5sum", std::string(32, '0')) + bagField("message_definition", ""));
}

std::string bagTime(std::int64_t stamp_ns)
{
  return WireWriter(Wire::Ros1).time(stamp_ns).bytes();
}

std::string bagChunk(const std::string& bytes, const std::string& compression)
{
  const std::string packed = compression == "lz4"   ? lz4(bytes)
                             : compression == "bz2" ? bzip2(bytes)
                                                    : bytes;
  return bagRecord(
      bagField("compression", compression) + bagField("op", "\x05") +
          bagField("size", word(static_cast<std::uint32_t>(bytes.size()))),
      packed);
}

std::string bagHead(std::uint64_t index_position, std::uint32_t connections, std::uint32_t chunks)
{
  constexpr std::size_t kPadded = 4096;
  const std::string head =
      bagField("chunk_count", word(chunks)) + bagField("conn_count", word(connections)) +
      bagField(
          "index_pos",
          std::string(reinterpret_cast<const char*>(&index_position), sizeof index_position)) +
      bagField("op", "\x03");
  return bagRecord(head, std::string(kPadded - head.size() - 8, ' '));
}

/** Offsets of the messages of one connection in its chunk. */
std::string indexRecord(std::uint32_t number, const std::vector<std::string>& entries)
{
  std::string data;
  for (const std::string& entry : entries)
    data += entry;
  return bagRecord(
      bagField("conn", word(number)) +
          bagField("count", word(static_cast<std::uint32_t>(entries.size()))) +
          bagField("op", "\x04") + bagField("ver", word(1)),
      data);
}

/** A bag while it grows. */
struct BagText
{
  std::string body, chunk, infos;
  std::map<std::string, std::uint32_t> numbers;
  std::map<std::uint32_t, std::vector<std::string>> entries;
  std::string first, last;
  std::uint32_t chunks = 0;
};

constexpr std::size_t kBagStart = 13 + 4096;

void closeChunk(BagText& bag, const BagStyle& style)
{
  if (bag.chunk.empty()) return;
  const std::uint64_t position = kBagStart + bag.body.size();
  bag.body += bagChunk(bag.chunk, style.compression);
  bag.chunk.clear();
  ++bag.chunks;
  if (!style.index) return;
  std::string counts;
  for (const auto& [number, entries] : bag.entries)
  {
    bag.body += indexRecord(number, entries);
    counts += word(number) + word(static_cast<std::uint32_t>(entries.size()));
  }
  bag.infos += bagRecord(
      bagField(
          "chunk_pos", std::string(reinterpret_cast<const char*>(&position), sizeof position)) +
          bagField("count", word(static_cast<std::uint32_t>(bag.entries.size()))) +
          bagField("end_time", bag.last) + bagField("op", "\x06") +
          bagField("start_time", bag.first) + bagField("ver", word(1)),
      counts);
  bag.entries.clear();
}
}  // namespace

std::string bagOf(const std::vector<TopicMessage>& messages, const BagStyle& style)
{
  BagText bag;
  std::string connections;
  std::size_t in_chunk = 0;
  for (const TopicMessage& message : messages)
  {
    const auto [number, is_new] =
        bag.numbers.try_emplace(message.topic, static_cast<std::uint32_t>(bag.numbers.size()));
    if (is_new) connections += connection(number->second, message);
    if (is_new) bag.chunk += connection(number->second, message);
    if (in_chunk++ == 0) bag.first = bagTime(message.stamp_ns);
    bag.last = bagTime(message.stamp_ns);
    bag.entries[number->second].push_back(
        bag.last + word(static_cast<std::uint32_t>(bag.chunk.size())));
    bag.chunk += bagRecord(
        bagField("conn", word(number->second)) + bagField("op", "\x02") +
            bagField("time", bag.last),
        message.data);
    if (in_chunk < style.chunk_messages) continue;
    closeChunk(bag, style);
    in_chunk = 0;
  }
  closeChunk(bag, style);
  const std::uint64_t index_position = style.index ? kBagStart + bag.body.size() : 0;
  const auto count = static_cast<std::uint32_t>(bag.numbers.size());
  return "#ROSBAG V2.0\n" + bagHead(index_position, count, bag.chunks) + bag.body +
         (style.index ? connections + bag.infos : "");
}

}  // namespace fastlio::testing
