// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_file.h"

#include "chunk_search.h"
#include <fastlio/options/printable.h>

namespace fastlio
{
namespace
{
const std::string kBagMagic = "#ROSBAG V";
const std::string kBagVersion = "#ROSBAG V2.0\n";
constexpr std::size_t kLargestHead = 65536;
constexpr std::size_t kMostConnections = 100'000;  // more than any recorder opens

const ChunkedFormat& bagFormat()
{
  static const ChunkedFormat format = {
      "a bag",
      kBagVersion.size(),
      "none, bz2 and lz4",
      {{"none", nullptr}, {"bz2", makeBzip2Inflater}, {"lz4", makeLz4Inflater}},
      findBagChunk};
  return format;
}
}  // namespace

bool isBag(const std::string& path)
{
  return headOf(path, kBagMagic.size()) == kBagMagic;
}

BagFile::BagFile(const std::string& path) : ChunkedFile(path, path, bagFormat())
{
  const std::string head = headOf(path, kBagVersion.size());
  if (head != kBagVersion)
    throw std::runtime_error(
        "is a bag of another version, '" + printable(head) +
        "'; version 2.0 is read, into which 'rosbag fix' converts");
  readList(indexPlace());
}

// The index at the end lists the connections, which a damaged chunk may keep to itself. What it
// holds about places is not used.
std::optional<std::uint64_t> BagFile::indexPlace()
{
  file_.seek(kBagVersion.size());
  const auto head_size = readNumber<std::uint32_t>(file_);
  if (!head_size || *head_size > kLargestHead || !readBytes(file_, *head_size, head_)) return {};
  const auto fields = BagFields::parse(head_.data(), head_.size());
  const auto place = fields ? fields->text("index_pos") : std::nullopt;
  if (!place || place->size() != sizeof(std::uint64_t)) return {};
  const auto position = littleAt<std::uint64_t>(place->data());
  if (position < kBagVersion.size() || position >= file_.size()) return {};
  return position;
}

BagFile::Step BagFile::readRecord(ByteSource& source, const TopicFilter& wanted)
{
  const bool outside = &source == &file_;
  if (outside && file_.left() == 0) return Step::Finished;
  const auto head_size = readNumber<std::uint32_t>(source);
  if (!head_size) return Step::Ended;
  if (*head_size > kLargestHead) return Step::Broken;
  if (!readBytes(source, *head_size, head_)) return Step::Ended;
  const auto fields = BagFields::parse(head_.data(), head_.size());
  if (!fields || !fields->op()) return Step::Broken;
  const auto data_size = readNumber<std::uint32_t>(source);
  if (!data_size) return Step::Ended;
  switch (*fields->op())
  {
    case BagOp::Message:
      return readMessageOf(source, *fields, *data_size, wanted);
    case BagOp::Connection:
      return readConnection(source, *fields, *data_size);
    case BagOp::Chunk:
      if (!outside) return Step::Broken;  // chunks do not hold chunks
      return openChunk(fields->text("compression").value_or(""), *data_size);
    case BagOp::BagHeader:
    case BagOp::Index:
    case BagOp::ChunkInfo:
      return source.skip(*data_size) ? Step::Other : Step::Ended;
  }
  return Step::Broken;
}

BagFile::Step BagFile::readMessageOf(
    ByteSource& source, const BagFields& fields, std::size_t size, const TopicFilter& wanted)
{
  const auto number = fields.number("conn");
  if (!number || size > kLargestRecord) return Step::Broken;
  if (connections_.size() >= kMostConnections && connections_.count(*number) == 0)
    return Step::Broken;
  RosTopic& topic = connections_[*number];
  if (topic.name.empty())
  {
    topic.name = "connection " + std::to_string(*number);
    topic.trouble = "no remaining record holds its topic and type";
  }
  return readMessage(source, topic, size, wanted);
}

BagFile::Step BagFile::readConnection(ByteSource& source, const BagFields& fields, std::size_t size)
{
  const auto number = fields.number("conn");
  if (!number || size > kLargestRecord) return Step::Broken;
  if (!readBytes(source, size, data_)) return Step::Ended;
  const auto inner = BagFields::parse(data_.data(), data_.size());
  if (!inner) return Step::Broken;
  // The index at the end lists them all again.
  if (connections_.count(*number) != 0 || connections_.size() >= kMostConnections)
    return Step::Other;
  const auto topic = fields.text("topic"), type = inner->text("type");
  connections_[*number] = {
      std::string(topic.value_or("")), std::string(type.value_or("")), WireFormat::Ros1, ""};
  return Step::Other;
}

std::vector<const RosTopic*> BagFile::topics() const
{
  std::vector<const RosTopic*> topics;
  for (const auto& [number, topic] : connections_)
    topics.push_back(&topic);
  return topics;
}

}  // namespace fastlio
