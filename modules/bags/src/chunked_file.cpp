// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "chunked_file.h"

#include <fastlio/options/printable.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Each search reads a little again, and hostile files would ask for millions.
constexpr std::size_t kMostSearches = 10'000;
constexpr const char* kCutOff =
    "The recording or a copy of it was cut off; everything before was read.";
constexpr const char* kCopyAnew = "Copy the file anew, or check the medium it lies on.";
}  // namespace

ChunkedFile::ChunkedFile(
    const std::string& path, std::string shown_name, const ChunkedFormat& format)
    : file_(path), shown_name_(std::move(shown_name)), format_(format)
{
}

void ChunkedFile::readList(std::optional<std::uint64_t> place)
{
  file_.seek(place.value_or(file_.size()));
  const TopicFilter nothing = [](const RosTopic&) { return false; };
  while (!isInChunk() && readRecord(file_, nothing) == Step::Other)
  {
  }
  chunk_ = {};
  lists_topics_ = !topics().empty();
  file_.seek(format_.first_record);
}

NextMessage ChunkedFile::next(const TopicFilter& wanted)
{
  while (!finished_)
  {
    if (!isInChunk()) record_ = file_.position();
    const Step step =
        readRecord(isInChunk() ? static_cast<ByteSource&>(*chunk_.bytes) : file_, wanted);
    if (const auto refused = std::exchange(chunk_.refused, {}))
      return problem(
          ReadProblemKind::NotSupported, "its compression '" + printable(*refused) +
                                             "' is not known (" + format_.known_compressions +
                                             " are). Its messages are left out.");
    if (step == Step::Message) return message_;
    if (step == Step::Other) continue;
    if (isInChunk())
    {
      if (auto broken = closeChunk(step)) return std::move(*broken);
      continue;
    }
    if (step != Step::Finished) return endOfFile(step);
    finished_ = true;
  }
  return EndOfRecording{};
}

ReadProblem ChunkedFile::problem(ReadProblemKind kind, const std::string& what) const
{
  return {
      shown_name_, kind, "",
      shown_name_ + ": the chunk or record at byte " + std::to_string(record_) + ": " + what};
}

// The records of a chunk have ended, or could not be read on.
std::optional<ReadProblem> ChunkedFile::closeChunk(Step step)
{
  const Chunk chunk = std::exchange(chunk_, {});
  file_.seek(chunk.end);
  finished_ = chunk.bytes->truncated() || chunk.end > file_.size();
  if (finished_)
    return problem(ReadProblemKind::Truncated, std::string("the file ends inside it. ") + kCutOff);
  const bool corrupt = chunk.bytes->corrupt();
  if (corrupt || step != Step::Ended)
    return problem(
        ReadProblemKind::Corrupt,
        std::string(corrupt ? "its compressed data are damaged. " : "a record of it is damaged. ") +
            "Its messages from there on are left out. " + kCopyAnew);
  const auto checksum = chunk.bytes->checksum();
  if (checksum && *checksum != chunk.checksum)
    return problem(
        ReadProblemKind::Corrupt,
        std::string("its checksum is wrong: some of its messages are damaged. ") + kCopyAnew);
  return std::nullopt;
}

// A wrong length, too, looks like the end.
ReadProblem ChunkedFile::endOfFile(Step step)
{
  const auto chunk =
      ++searches_ <= kMostSearches ? format_.find_chunk(file_, record_ + 1) : std::nullopt;
  finished_ = !chunk;
  file_.seek(chunk.value_or(file_.size()));
  if (finished_ && step == Step::Ended)
    return problem(
        ReadProblemKind::Truncated,
        std::string(
            record_ < file_.size() ? "the file ends inside it. "
                                   : "the file ends without the mark of its end. ") +
            kCutOff);
  return problem(
      ReadProblemKind::Corrupt, std::string("it is no record of ") + format_.name + "; " +
                                    (finished_ ? "nothing behind it can be read. "
                                               : "reading goes on with the chunk at byte " +
                                                     std::to_string(file_.position()) + ". ") +
                                    kCopyAnew);
}

ChunkedFile::Step ChunkedFile::readMessage(
    ByteSource& source, const RosTopic& topic, std::size_t size, const TopicFilter& wanted)
{
  message_ = {&topic, nullptr, record_};
  if (!wanted(topic)) return source.skip(size) ? Step::Message : Step::Ended;
  if (!readBytes(source, size, data_)) return Step::Ended;
  message_.data = &data_;
  return Step::Message;
}

ChunkedFile::Step ChunkedFile::openChunk(
    std::string_view compression, std::uint64_t size, std::uint32_t checksum)
{
  const auto& known = format_.compressions;
  const auto found = std::find_if(
      known.begin(), known.end(), [&](const auto& one) { return one.first == compression; });
  if (found == known.end())
  {
    chunk_.refused = std::string(compression);
    return file_.skip(size) ? Step::Other : Step::Ended;
  }
  auto inflater = found->second == nullptr ? nullptr : found->second();
  chunk_.end = file_.position() + size;
  chunk_.checksum = checksum;
  chunk_.bytes = std::make_unique<StretchBytes>(file_, size, std::move(inflater), checksum != 0);
  return Step::Other;
}

}  // namespace fastlio
