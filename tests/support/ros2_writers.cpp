// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ros2_writers.h"

#include "test_files.h"

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sqlite3.h>
#include <stdexcept>
#include <zlib.h>

namespace fastlio::testing
{
namespace
{
const std::string kMcapMagic = "\x89MCAP0\r\n";

/** Numbers and texts of a record: little endian, packed. */
WireWriter content()
{
  return WireWriter(Wire::Ros1);
}

std::string mcapRecord(std::uint8_t op, const std::string& bytes)
{
  return content().number(op).number(std::uint64_t{bytes.size()}).raw(bytes).bytes();
}

/** "sensor_msgs/Imu" as ROS 2 calls it. */
std::string ros2Type(const std::string& type)
{
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

std::string mcapChannel(std::uint16_t id, const TopicMessage& message, const std::string& encoding)
{
  const std::string type = encoding == "cdr" ? ros2Type(message.type) : message.type;
  const auto schema_id = static_cast<std::uint16_t>(id + 1);
  const std::string schema =
      content().number(schema_id).text(type).text("ros2msg").number(std::uint32_t{0}).bytes();
  const std::string channel = content()
                                  .number(id)
                                  .number(schema_id)
                                  .text(message.topic)
                                  .text(encoding)
                                  .number(std::uint32_t{0})
                                  .bytes();
  return mcapRecord(0x03, schema) + mcapRecord(0x04, channel);
}

std::string mcapMessage(std::uint16_t channel, const TopicMessage& message)
{
  const auto stamp = static_cast<std::uint64_t>(message.stamp_ns);
  return mcapRecord(
      0x05, content()
                .number(channel)
                .number(std::uint32_t{0})
                .number(stamp)
                .number(stamp)
                .raw(message.data)
                .bytes());
}

std::string mcapChunk(const std::string& bytes, const std::string& compression)
{
  const std::string packed = compression == "lz4"    ? lz4(bytes)
                             : compression == "zstd" ? zstd(bytes)
                                                     : bytes;
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  return mcapRecord(
      0x06, content()
                .number(std::uint64_t{0})
                .number(std::uint64_t{0})
                .number(std::uint64_t{bytes.size()})
                .number(checksum)
                .text(compression == "none" ? "" : compression)
                .number(std::uint64_t{packed.size()})
                .raw(packed)
                .bytes());
}

/** Offsets of message indexes are not looked at by anybody here. */
std::string mcapChunkIndex(
    std::uint64_t begin, std::uint64_t size, const std::set<std::uint16_t>& channels,
    const BagStyle& style)
{
  WireWriter offsets = content();
  for (const std::uint16_t channel : channels)
    offsets.number(channel).number(begin);
  return mcapRecord(
      0x08, content()
                .number(std::uint64_t{0})
                .number(std::uint64_t{0})
                .number(begin)
                .number(size)
                .text(offsets.bytes())
                .number(std::uint64_t{0})
                .text(style.compression == "none" ? "" : style.compression)
                .number(std::uint64_t{0})
                .number(std::uint64_t{0})
                .bytes());
}

void run(sqlite3* database, const char* text)
{
  if (sqlite3_exec(database, text, nullptr, nullptr, nullptr) != SQLITE_OK)
    throw std::runtime_error(sqlite3_errmsg(database));
}

void insert(sqlite3* database, const char* text, std::int64_t number, const TopicMessage& message)
{
  sqlite3_stmt* raw = nullptr;
  sqlite3_prepare_v2(database, text, -1, &raw, nullptr);
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> row(raw, sqlite3_finalize);
  const std::string type = ros2Type(message.type);
  sqlite3_bind_int64(raw, 1, number);
  if (sqlite3_bind_parameter_count(raw) == 3 &&
      std::string(text).find("topics(") != std::string::npos)
  {
    sqlite3_bind_text(raw, 2, message.topic.c_str(), -1, SQLITE_TRANSIENT);
    sqlite3_bind_text(raw, 3, type.c_str(), -1, SQLITE_TRANSIENT);
  }
  else
  {
    sqlite3_bind_int64(raw, 2, message.stamp_ns);
    sqlite3_bind_blob(
        raw, 3, message.data.data(), static_cast<int>(message.data.size()), SQLITE_TRANSIENT);
  }
  if (sqlite3_step(raw) != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(database));
}
}  // namespace

std::string mcapOf(
    const std::vector<TopicMessage>& messages, const BagStyle& style, const std::string& encoding)
{
  std::map<std::string, std::uint16_t> channels;
  const std::string head =
      kMcapMagic + mcapRecord(0x01, content().text("ros2").text("test").bytes());
  std::string body, chunk, summary, indexes;
  std::set<std::uint16_t> in_this_chunk;
  std::size_t in_chunk = 0;
  const bool chunks = style.chunk_messages > 0;
  const auto closeChunk = [&]
  {
    const std::uint64_t begin = head.size() + body.size();
    body += mcapChunk(chunk, style.compression);
    indexes += mcapChunkIndex(begin, head.size() + body.size() - begin, in_this_chunk, style);
    chunk.clear();
    in_this_chunk.clear();
    in_chunk = 0;
  };
  for (const TopicMessage& message : messages)
  {
    const auto [channel, is_new] =
        channels.try_emplace(message.topic, static_cast<std::uint16_t>(channels.size()));
    std::string& to = chunks ? chunk : body;
    if (is_new) to += mcapChannel(channel->second, message, encoding);
    if (is_new) summary += mcapChannel(channel->second, message, encoding);
    to += mcapMessage(channel->second, message);
    in_this_chunk.insert(channel->second);
    if (chunks && ++in_chunk == style.chunk_messages) closeChunk();
  }
  if (!chunk.empty()) closeChunk();
  summary += indexes;
  body += mcapRecord(0x0F, content().number(std::uint32_t{0}).bytes());
  const std::uint64_t summary_start = style.index ? head.size() + body.size() : 0;
  const std::string footer = mcapRecord(
      0x02,
      content().number(summary_start).number(std::uint64_t{0}).number(std::uint32_t{0}).bytes());
  return head + body + (style.index ? summary : "") + footer + kMcapMagic;
}

void writeDb3(const std::string& path, const std::vector<TopicMessage>& messages)
{
  std::filesystem::remove(path);
  sqlite3* raw = nullptr;
  if (sqlite3_open(path.c_str(), &raw) != SQLITE_OK) throw std::runtime_error("sqlite3_open");
  const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(raw, sqlite3_close);
  run(raw,
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER "
      "NOT NULL, data BLOB NOT NULL);"
      "CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN");
  std::map<std::string, std::int64_t> topics;
  for (const TopicMessage& message : messages)
  {
    const auto [topic, is_new] =
        topics.try_emplace(message.topic, static_cast<std::int64_t>(topics.size() + 1));
    if (is_new)
      insert(
          raw,
          "INSERT INTO topics(id, name, type, serialization_format, offered_qos_profiles) "
          "VALUES (?, ?, ?, 'cdr', '')",
          topic->second, message);
    insert(
        raw, "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", topic->second,
        message);
  }
  run(raw, "COMMIT");
}

}  // namespace fastlio::testing
