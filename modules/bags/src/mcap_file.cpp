// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_file.h"

#include "chunk_search.h"
#include "mcap_record.h"

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

const ChunkedFormat& mcapFormat()
{
  static const ChunkedFormat format = {
      "MCAP",
      mcapMagic().size(),
      "none, lz4 and zstd",
      {{"", nullptr}, {"lz4", makeLz4Inflater}, {"zstd", makeZstdInflater}},
      findMcapChunk};
  return format;
}
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
    : ChunkedFile(path, std::move(shown_name), mcapFormat())
{
  if (!isMcap(path)) throw std::runtime_error("is no MCAP file of version 0");
  readList(summaryPlace());
}

// The summary repeats the channels, which a damaged chunk may keep to itself.
std::optional<std::uint64_t> McapFile::summaryPlace()
{
  constexpr std::uint64_t kFooter = kRecordHead + 20, kEnd = 8;
  if (file_.size() < kFooter + 2 * kEnd) return {};
  file_.seek(file_.size() - kEnd - kFooter);
  const auto op = readNumber<std::uint8_t>(file_);
  const auto size = readNumber<std::uint64_t>(file_);
  const auto begin = readNumber<std::uint64_t>(file_);
  if (op != kFooterOp || size != 20U || !begin || *begin == 0 || *begin >= file_.size()) return {};
  return begin;
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
      return readMessageOf(source, *size, wanted);
    case kChunkOp:
      return outside ? readChunkHead(*size, wanted) : Step::Broken;  // chunks do not hold chunks
    case kFooterOp:
    case kDataEndOp:
      return outside ? Step::Finished : Step::Broken;
    default:
      break;
  }
  if (*op == 0 || (*op > kLastKnownOp && *op < kFirstPrivateOp)) return Step::Broken;
  return source.skip(*size) ? Step::Other : Step::Ended;
}

McapFile::Step McapFile::readMessageOf(
    ByteSource& source, std::uint64_t size, const TopicFilter& wanted)
{
  if (size < kMessageHead || size > kLargestRecord) return Step::Broken;
  const auto channel = readNumber<std::uint16_t>(source);
  std::uint8_t times[kMessageHead - sizeof(std::uint16_t)];  // read, as the checksum asks for it
  if (!channel || source.read(times, sizeof times) < sizeof times) return Step::Ended;
  return readMessage(source, definitions_.channel(*channel), size - kMessageHead, wanted);
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
  return leave_out_ && chunks_.holdsNone(recordPlace(), isWanted);
}

McapFile::Step McapFile::readChunkHead(std::uint64_t size, const TopicFilter& wanted)
{
  constexpr std::size_t kLongestName = 64;
  if (size < kCompressionAt || file_.position() + size < size) return Step::Broken;
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
  return openChunk(compression, *packed, *checksum);
}

}  // namespace fastlio
