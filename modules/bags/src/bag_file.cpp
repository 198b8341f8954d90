// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_file.h"

#include "chunk_search.h"
#include <fastlio/options/printable.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
const std::string kBagMagic = "#ROSBAG V";
const std::string kBagVersion = "#ROSBAG V2.0\n";
constexpr std::size_t kLargestHead = 65536;
constexpr std::size_t kMostConnections = 100'000;  // more than any recorder opens
constexpr const char* kCutOff =
    "The recording or a copy of it was cut off; everything before was read.";
constexpr const char* kCopyAnew = "Copy the file anew, or check the medium it lies on.";
}  // namespace

bool isBag(const std::string& path)
{
  return headOf(path, kBagMagic.size()) == kBagMagic;
}

BagFile::BagFile(const std::string& path) : path_(path), file_(path)
{
  const std::string head = headOf(path, kBagVersion.size());
  if (head != kBagVersion)
    throw std::runtime_error(
        "is a bag of another version, '" + printable(head) +
        "'; version 2.0 is read, into which 'rosbag fix' converts");
  readIndex();
  file_.seek(kBagVersion.size());
}

// The index at the end lists the connections, which a damaged chunk may keep to itself. What it
// holds about places is not used.
void BagFile::readIndex()
{
  file_.seek(kBagVersion.size());
  const auto head_size = readNumber<std::uint32_t>(file_);
  if (!head_size || *head_size > kLargestHead || !readBytes(file_, *head_size, head_)) return;
  const auto fields = BagFields::parse(head_.data(), head_.size());
  const auto place = fields ? fields->text("index_pos") : std::nullopt;
  if (!place || place->size() != sizeof(std::uint64_t)) return;
  const auto position = littleAt<std::uint64_t>(place->data());
  if (position < kBagVersion.size() || position >= file_.size()) return;
  file_.seek(position);
  const TopicFilter nothing = [](const RosTopic&) { return false; };
  while (!chunk_ && readRecord(file_, nothing) == Step::Other)
  {
  }
  chunk_.reset();
  refused_.clear();
  lists_topics_ = !connections_.empty();
}

NextMessage BagFile::next(const TopicFilter& wanted)
{
  while (!finished_)
  {
    if (!chunk_) record_ = file_.position();
    const Step step = readRecord(chunk_ ? static_cast<ByteSource&>(*chunk_) : file_, wanted);
    if (!refused_.empty())
      return problemAt(
          path_, ReadProblemKind::NotSupported, record_,
          "its compression '" + printable(std::exchange(refused_, "")) +
              "' is not known (none, bz2 and lz4 are). Its messages are left out.");
    if (step == Step::Message) return message_;
    if (step == Step::Other) continue;
    if (!chunk_) return endOfFile(step);
    if (auto broken = closeChunk(step)) return std::move(*broken);
  }
  return EndOfRecording{};
}

// The records of a chunk have ended, or could not be read on.
std::optional<ReadProblem> BagFile::closeChunk(Step step)
{
  const bool truncated = chunk_->truncated(), corrupt = chunk_->corrupt();
  chunk_.reset();
  const bool whole = chunk_end_ <= file_.size();
  file_.seek(chunk_end_);
  finished_ = truncated || !whole;
  if (finished_)
    return problemAt(
        path_, ReadProblemKind::Truncated, record_,
        std::string("the file ends inside it. ") + kCutOff);
  if (corrupt || step == Step::Broken)
    return problemAt(
        path_, ReadProblemKind::Corrupt, record_,
        std::string(corrupt ? "its compressed data are damaged. " : "a record of it is damaged. ") +
            "Its messages from there on are left out. " + kCopyAnew);
  return std::nullopt;
}

NextMessage BagFile::endOfFile(Step step)
{
  if (step == Step::End && record_ == file_.size())
  {
    finished_ = true;
    return EndOfRecording{};
  }
  const auto chunk = ++searches_ <= kMostSearches ? findBagChunk(file_, record_ + 1) : std::nullopt;
  finished_ = !chunk;
  file_.seek(chunk.value_or(file_.size()));
  if (chunk)
    return problemAt(
        path_, ReadProblemKind::Corrupt, record_,
        "it is no record of a bag; reading goes on with the chunk at byte " +
            std::to_string(file_.position()) + ". " + kCopyAnew);
  return problemAt(
      path_, step == Step::End ? ReadProblemKind::Truncated : ReadProblemKind::Corrupt, record_,
      step == Step::End ? std::string("the file ends inside it. ") + kCutOff
                        : std::string("it is no record of a bag. ") + kCopyAnew);
}

BagFile::Step BagFile::readRecord(ByteSource& source, const TopicFilter& wanted)
{
  const auto head_size = readNumber<std::uint32_t>(source);
  if (!head_size) return Step::End;
  if (*head_size > kLargestHead) return Step::Broken;
  if (!readBytes(source, *head_size, head_)) return Step::End;
  const auto fields = BagFields::parse(head_.data(), head_.size());
  if (!fields || !fields->op()) return Step::Broken;
  const auto data_size = readNumber<std::uint32_t>(source);
  if (!data_size) return Step::End;
  switch (*fields->op())
  {
    case BagOp::Message:
      return readMessage(source, *fields, *data_size, wanted);
    case BagOp::Connection:
      return readConnection(source, *fields, *data_size);
    case BagOp::Chunk:
      if (!chunk_) return openChunk(*fields, *data_size);
      return Step::Broken;  // chunks do not hold chunks
    case BagOp::BagHeader:
    case BagOp::Index:
    case BagOp::ChunkInfo:
      return source.skip(*data_size) ? Step::Other : Step::End;
  }
  return Step::Broken;
}

BagFile::Step BagFile::readMessage(
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
  message_ = {&topic, nullptr, record_};
  if (!wanted(topic)) return source.skip(size) ? Step::Message : Step::End;
  if (!readBytes(source, size, data_)) return Step::End;
  message_.data = &data_;
  return Step::Message;
}

BagFile::Step BagFile::readConnection(ByteSource& source, const BagFields& fields, std::size_t size)
{
  const auto number = fields.number("conn");
  if (!number || size > kLargestRecord) return Step::Broken;
  if (!readBytes(source, size, data_)) return Step::End;
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

BagFile::Step BagFile::openChunk(const BagFields& fields, std::size_t size)
{
  const std::string compression(fields.text("compression").value_or(""));
  chunk_end_ = file_.position() + size;
  std::unique_ptr<Inflater> inflater;
  if (compression == "bz2")
    inflater = makeBzip2Inflater();
  else if (compression == "lz4")
    inflater = makeLz4Inflater();
  else if (compression != "none")
  {
    refused_ = compression;
    return file_.skip(size) ? Step::Other : Step::End;
  }
  chunk_ = std::make_unique<StretchBytes>(file_, size, std::move(inflater));
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
