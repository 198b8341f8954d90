// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_file.h"

#include "chunk_search.h"
#include "mcap_record.h"
#include <fastlio/options/printable.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
// Opcodes above the last one that the format knows belong to nobody, or to private records.
constexpr std::uint8_t kLastKnownOp = kDataEndOp, kFirstPrivateOp = 0x80;
constexpr std::size_t kRecordHead = 9;      // opcode and length
constexpr std::size_t kMessageHead = 22;    // ahead of a message's data
constexpr std::size_t kCompressionAt = 28;  // in a chunk
}  // namespace

const std::string& mcapMagic()
{
  static const std::string magic = "\x89MCAP0\r\n";
  return magic;
}

bool isMcap(const std::string& path)
{
  return headOf(path, mcapMagic().size()) == mcapMagic();
}

McapFile::McapFile(const std::string& path) : McapFile(path, path) {}

McapFile::McapFile(const std::string& path, std::string shown_name)
    : shown_name_(std::move(shown_name)), file_(path)
{
  if (!isMcap(path)) throw std::runtime_error("is no MCAP file of version 0");
  readSummary();
  file_.seek(mcapMagic().size());
}

// The summary repeats the channels, which a damaged chunk may keep to itself.
void McapFile::readSummary()
{
  constexpr std::uint64_t kFooter = kRecordHead + 20, kEnd = 8;
  if (file_.size() < kFooter + 2 * kEnd) return;
  file_.seek(file_.size() - kEnd - kFooter);
  const auto op = readNumber<std::uint8_t>(file_);
  const auto size = readNumber<std::uint64_t>(file_);
  const auto begin = readNumber<std::uint64_t>(file_);
  if (op != kFooterOp || size != 20U || !begin || *begin == 0 || *begin >= file_.size()) return;
  file_.seek(*begin);
  const TopicFilter nothing = [](const RosTopic&) { return false; };
  while (!chunk_.bytes && readRecord(file_, nothing) == Step::Other)
  {
  }
  chunk_ = {};
  lists_topics_ = !definitions_.topics().empty();
}

NextMessage McapFile::next(const TopicFilter& wanted)
{
  while (!finished_)
  {
    if (!chunk_.bytes) record_ = file_.position();
    const Step step =
        readRecord(chunk_.bytes ? static_cast<ByteSource&>(*chunk_.bytes) : file_, wanted);
    if (!chunk_.refused.empty())
      return problemAt(
          shown_name_, ReadProblemKind::NotSupported, record_,
          "its compression '" + printable(std::exchange(chunk_.refused, "")) +
              "' is not known (none, lz4 and zstd are). Its messages are left out.");
    if (step == Step::Message) return message_;
    if (step == Step::Other) continue;
    if (chunk_.bytes)
    {
      if (auto broken = closeChunk(step)) return std::move(*broken);
      continue;
    }
    if (step != Step::Finished) return endOfFile(step);
    finished_ = true;
  }
  return EndOfRecording{};
}

std::optional<ReadProblem> McapFile::closeChunk(Step step)
{
  const auto checksum = chunk_.bytes->checksum();
  const bool truncated = chunk_.bytes->truncated() || chunk_.end > file_.size();
  const bool corrupt = chunk_.bytes->corrupt(), broken = step != Step::Ended;
  const bool differs = checksum && chunk_.checksum != 0 && *checksum != chunk_.checksum;
  file_.seek(chunk_.end);
  chunk_ = {};
  finished_ = truncated;
  if (truncated)
    return problemAt(
        shown_name_, ReadProblemKind::Truncated, record_,
        "the file ends inside it. The recording or a copy of it was cut off; everything before was "
        "read.");
  if (corrupt || broken)
    return problemAt(
        shown_name_, ReadProblemKind::Corrupt, record_,
        std::string(corrupt ? "its compressed data are damaged. " : "a record of it is damaged. ") +
            "Its messages from there on are left out. Copy the file anew, or check the medium.");
  if (differs)
    return problemAt(
        shown_name_, ReadProblemKind::Corrupt, record_,
        "its checksum is wrong: some of its messages are damaged. Copy the file anew.");
  return std::nullopt;
}

ReadProblem McapFile::endOfFile(Step step)
{
  if (step == Step::Ended)
  {
    finished_ = true;
    return problemAt(
        shown_name_, ReadProblemKind::Truncated, record_,
        "the file ends without the mark of its end. The recording or a copy of it was cut off; "
        "everything before was read.");
  }
  const auto chunk =
      ++searches_ <= kMostSearches ? findMcapChunk(file_, record_ + 1) : std::nullopt;
  finished_ = !chunk;
  file_.seek(chunk.value_or(file_.size()));
  return problemAt(
      shown_name_, ReadProblemKind::Corrupt, record_,
      "it is no record of MCAP; " +
          (finished_ ? std::string("nothing behind it can be read. ")
                     : "reading goes on with the chunk at byte " +
                           std::to_string(file_.position()) + ". ") +
          "Copy the file anew, or check the medium.");
}

McapFile::Step McapFile::readRecord(ByteSource& source, const TopicFilter& wanted)
{
  const auto op = readNumber<std::uint8_t>(source);
  const auto size = readNumber<std::uint64_t>(source);
  if (!op || !size) return Step::Ended;
  const bool outside = &source == &file_;
  if (outside && *size > file_.left() && *op != kChunkOp && *op != kMessageOp)
    return *op > 0 && *op <= kLastKnownOp ? Step::Ended : Step::Broken;
  switch (*op)
  {
    case kSchemaOp:
    case kChannelOp:
    case kChunkIndexOp:
      return readDefinition(*op, source, *size);
    case kMessageOp:
      return readMessage(source, *size, wanted);
    case kChunkOp:
      return outside ? openChunk(*size, wanted) : Step::Broken;  // chunks do not hold chunks
    case kFooterOp:
    case kDataEndOp:
      return outside ? Step::Finished : Step::Broken;
    default:
      break;
  }
  if (*op == 0 || (*op > kLastKnownOp && *op < kFirstPrivateOp)) return Step::Broken;
  return source.skip(*size) ? Step::Other : Step::Ended;
}

McapFile::Step McapFile::readMessage(
    ByteSource& source, std::uint64_t size, const TopicFilter& wanted)
{
  if (size < kMessageHead || size > kLargestRecord) return Step::Broken;
  const auto channel = readNumber<std::uint16_t>(source);
  std::uint8_t times[kMessageHead - sizeof(std::uint16_t)];  // read, as the checksum asks for it
  if (!channel || source.read(times, sizeof times) < sizeof times) return Step::Ended;
  const RosTopic& topic = definitions_.channel(*channel);
  message_ = {&topic, nullptr, record_};
  size -= kMessageHead;
  if (!wanted(topic)) return source.skip(size) ? Step::Message : Step::Ended;
  if (!readBytes(source, size, data_)) return Step::Ended;
  message_.data = &data_;
  return Step::Message;
}

McapFile::Step McapFile::readDefinition(std::uint8_t op, ByteSource& source, std::uint64_t size)
{
  if (size > kLargestRecord) return Step::Broken;
  if (!readBytes(source, size, data_)) return Step::Ended;
  if (op == kChunkIndexOp) chunks_.add(data_);
  const bool broken = (op == kSchemaOp && !definitions_.addSchema(data_)) ||
                      (op == kChannelOp && !definitions_.addChannel(data_));
  return broken ? Step::Broken : Step::Other;
}

bool McapFile::isLeftOut(const TopicFilter& wanted) const
{
  const auto isWanted = [&](std::uint16_t id)
  {
    const RosTopic* topic = definitions_.find(id);
    return topic == nullptr || wanted(*topic);
  };
  return leave_out_ && chunks_.holdsNone(record_, isWanted);
}

McapFile::Step McapFile::openChunk(std::uint64_t size, const TopicFilter& wanted)
{
  constexpr std::size_t kLongestName = 64;
  const std::uint64_t end = file_.position() + size;
  if (size < kCompressionAt || end < size) return Step::Broken;
  if (isLeftOut(wanted)) return file_.skip(size) ? Step::Other : Step::Ended;
  if (!file_.skip(kCompressionAt - sizeof(std::uint32_t))) return Step::Ended;
  const auto checksum = readNumber<std::uint32_t>(file_);
  const auto length = readNumber<std::uint32_t>(file_);
  if (!checksum || !length) return Step::Ended;
  if (*length > kLongestName) return Step::Broken;
  std::string compression(*length, '\0');
  if (file_.read(reinterpret_cast<std::uint8_t*>(compression.data()), *length) < *length)
    return Step::Ended;
  const auto packed = readNumber<std::uint64_t>(file_);
  if (!packed) return Step::Ended;
  if (*packed != size - (kCompressionAt + 4 + *length + 8)) return Step::Broken;
  std::unique_ptr<Inflater> inflater;
  if (compression == "lz4")
    inflater = makeLz4Inflater();
  else if (compression == "zstd")
    inflater = makeZstdInflater();
  else if (!compression.empty())
  {
    chunk_.refused = compression;
    return file_.skip(*packed) ? Step::Other : Step::Ended;
  }
  chunk_ = {
      std::make_unique<StretchBytes>(file_, *packed, std::move(inflater), *checksum != 0), end,
      *checksum, ""};
  return Step::Other;
}

}  // namespace fastlio
