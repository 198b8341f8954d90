// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_container.h"

#include "mcap_file.h"
#include "mcap_record.h"
#include <fastlio/messages/ros2_definitions.h>

#include <algorithm>
#include <stdexcept>
#include <zlib.h>
#include <zstd.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kChunkBytes = std::size_t{4} << 20U;

std::string zstdOf(const std::string& bytes)
{
  constexpr int kFast = 1;
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kFast);
  if (ZSTD_isError(size) != 0) throw std::runtime_error("a chunk cannot be compressed");
  packed.resize(size);
  return packed;
}
}  // namespace

McapContainer::McapContainer(const std::string& path) : file_(path)
{
  put(mcapMagic() + McapRecord().text("ros2").text("mrpt_fastlio").finish(kHeaderOp));
}

void McapContainer::put(const std::string& bytes)
{
  file_.write(bytes);
  position_ += bytes.size();
}

std::uint16_t McapContainer::channelOf(const std::string& topic, const std::string& type)
{
  const auto [channel, is_new] =
      channels_.try_emplace(topic, static_cast<std::uint16_t>(channels_.size()));
  if (!is_new) return channel->second;
  const auto schema = static_cast<std::uint16_t>(channel->second + 1);
  const std::string records = McapRecord()
                                  .number(schema)
                                  .text(type)
                                  .text("ros2msg")
                                  .text(ros2DefinitionOf(type))
                                  .finish(kSchemaOp) +
                              McapRecord()
                                  .number(channel->second)
                                  .number(schema)
                                  .text(topic)
                                  .text("cdr")
                                  .number(std::uint32_t{0})
                                  .finish(kChannelOp);
  chunk_ += records;
  definitions_ += records;
  return channel->second;
}

void McapContainer::message(
    const std::string& topic, const std::string& type, std::int64_t stamp_ns,
    const std::string& data)
{
  const std::uint16_t channel = channelOf(topic, type);
  const auto stamp = static_cast<std::uint64_t>(std::max<std::int64_t>(stamp_ns, 0));
  index_[channel].push_back({stamp, chunk_.size()});
  ++counts_[channel];
  first_ = std::min(first_, stamp);
  last_ = std::max(last_, stamp);
  chunk_ += McapRecord()
                .number(channel)
                .number(std::uint32_t{0})
                .number(stamp)
                .number(stamp)
                .raw(data)
                .finish(kMessageOp);
  if (chunk_.size() >= kChunkBytes) closeChunk();
}

void McapContainer::closeChunk()
{
  if (chunk_.empty()) return;
  const std::string packed = zstdOf(chunk_);
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(chunk_.data()), chunk_.size()));
  const std::uint64_t begin = position_;
  put(McapRecord()
          .number(first_)
          .number(last_)
          .number(std::uint64_t{chunk_.size()})
          .number(checksum)
          .text("zstd")
          .number(std::uint64_t{packed.size()})
          .raw(packed)
          .finish(kChunkOp));
  const std::uint64_t end = position_;
  McapRecord offsets;
  for (const auto& [channel, entries] : index_)
  {
    offsets.number(channel).number(position_);
    McapRecord list;
    for (const IndexEntry& entry : entries)
      list.number(entry.stamp).number(entry.offset);
    put(McapRecord().number(channel).text(list.bytes()).finish(kMessageIndexOp));
  }
  chunk_indexes_ += McapRecord()
                        .number(first_)
                        .number(last_)
                        .number(begin)
                        .number(end - begin)
                        .text(offsets.bytes())
                        .number(position_ - end)
                        .text("zstd")
                        .number(std::uint64_t{packed.size()})
                        .number(std::uint64_t{chunk_.size()})
                        .finish(kChunkIndexOp);
  ++chunks_;
  begin_ = std::min(begin_, first_);
  end_ = std::max(end_, last_);
  chunk_.clear();
  index_.clear();
  first_ = std::numeric_limits<std::uint64_t>::max();
  last_ = 0;
}

std::string McapContainer::statistics() const
{
  McapRecord counts;
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_)
  {
    counts.number(channel).number(count);
    messages += count;
  }
  return McapRecord()
      .number(messages)
      .number(static_cast<std::uint16_t>(channels_.size()))
      .number(static_cast<std::uint32_t>(channels_.size()))
      .number(std::uint32_t{0})
      .number(std::uint32_t{0})
      .number(chunks_)
      .number(messages == 0 ? std::uint64_t{0} : begin_)
      .number(end_)
      .text(counts.bytes())
      .finish(kStatisticsOp);
}

OutputFile McapContainer::commit()
{
  closeChunk();
  put(McapRecord().number(std::uint32_t{0}).finish(kDataEndOp));
  const std::uint64_t summary = position_;
  put(definitions_ + chunk_indexes_ + statistics());
  put(McapRecord()
          .number(summary)
          .number(std::uint64_t{0})
          .number(std::uint32_t{0})
          .finish(kFooterOp) +
      mcapMagic());
  return file_.commit();
}

}  // namespace fastlio
