// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "checksum.h"
#include <fastlio/files/input_file.h>
#include <fastlio/recordings/byte_source.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kPiece = std::size_t{1} << 20U;
constexpr std::size_t kStretchBuffer = std::size_t{1} << 18U;
constexpr std::size_t kSmallRead = 4096, kReady = std::size_t{1} << 15U;
}  // namespace

bool ByteSource::skip(std::uint64_t size)
{
  std::array<std::uint8_t, 4096> piece{};
  while (size > 0)
  {
    const std::size_t got = read(piece.data(), std::min<std::uint64_t>(size, piece.size()));
    if (got == 0) return false;
    size -= got;
  }
  return true;
}

bool readBytes(ByteSource& source, std::size_t size, Bytes& bytes)
{
  bytes.clear();
  while (bytes.size() < size)
  {
    const std::size_t old_size = bytes.size();
    const std::size_t wanted = std::min(size - old_size, std::max(kPiece, old_size));
    bytes.resize(old_size + wanted);
    const std::size_t got = source.read(bytes.data() + old_size, wanted);
    bytes.resize(old_size + got);
    if (got < wanted) return false;
  }
  return true;
}

FileBytes::FileBytes(const std::string& path)
{
  if (const auto problem = inputFileProblem(path)) throw std::runtime_error(*problem);
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) throw std::runtime_error("cannot be opened");
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) throw std::runtime_error("cannot be read: " + error.message());
}

std::size_t FileBytes::read(std::uint8_t* data, std::size_t size)
{
  const std::size_t got = std::fread(data, 1, size, file_.get());
  position_ += got;
  size_ = got < size ? position_ : std::max(size_, position_);
  return got;
}

bool FileBytes::skip(std::uint64_t size)
{
  const bool there = size <= left();
  seek(there ? position_ + size : size_);
  return there;
}

void FileBytes::seek(std::uint64_t position)
{
  position_ = std::min(position, size_);
  if (fseeko(file_.get(), static_cast<off_t>(position_), SEEK_SET) != 0)
    throw std::runtime_error("the file cannot be read at byte " + std::to_string(position_));
}

StretchBytes::StretchBytes(
    FileBytes& file, std::uint64_t size, std::unique_ptr<Inflater> inflater, bool with_checksum)
    : file_(file), left_(size), inflater_(std::move(inflater)), with_checksum_(with_checksum)
{
  if (inflater_) buffer_.resize(kStretchBuffer);
}

// Fills the buffer up behind what is left in it.
void StretchBytes::load()
{
  const auto waiting_bytes = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
  std::copy(waiting_bytes, buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ = waiting();
  begin_ = 0;
  const auto wanted =
      static_cast<std::size_t>(std::min<std::uint64_t>(left_, buffer_.size() - end_));
  const std::size_t got = file_.read(buffer_.data() + end_, wanted);
  end_ += got;
  left_ -= got;
  truncated_ |= got < wanted;
}

bool StretchBytes::beginsAnotherMember()
{
  if (!member_magic_) return false;
  const std::string_view& magic = *member_magic_;
  const std::size_t least = std::max<std::size_t>(magic.size(), 1);
  if (waiting() < least) load();
  if (waiting() < least) return false;
  const std::string_view next(reinterpret_cast<const char*>(buffer_.data() + begin_), magic.size());
  if (next != magic) return false;
  inflater_->reset();
  return true;
}

std::size_t StretchBytes::inflate(std::uint8_t* data, std::size_t size)
{
  if (begin_ == end_) load();
  const auto step = inflater_->step(
      buffer_.data() + begin_, static_cast<std::uint32_t>(end_ - begin_), data,
      static_cast<std::uint32_t>(std::min<std::size_t>(size, kPiece)));
  begin_ += step.consumed;
  corrupt_ = step.status == InflateStatus::Corrupt;
  const bool stuck = step.consumed == 0 && step.produced == 0;
  const bool more = !truncated_ || waiting() > 0;
  if (stuck && !corrupt_ && more) corrupt_ = step.status == InflateStatus::Going;
  whole_ = step.status == InflateStatus::MemberEnd && !beginsAnotherMember();
  ended_ = corrupt_ || stuck || whole_;
  return step.produced;
}

std::size_t StretchBytes::read(std::uint8_t* data, std::size_t size)
{
  if (!inflater_)
  {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(size, left_));
    const std::size_t got = file_.read(data, wanted);
    left_ -= got;
    truncated_ |= got < wanted;
    if (with_checksum_) checksum_ = crc32With(checksum_, data, got);
    return got;
  }
  std::size_t done = takeReady(data, size);
  while (done < size && !ended_)
  {
    // Numbers come out of a store: a library takes its time for each call.
    if (size - done < kSmallRead)
    {
      ready_.resize(kReady);
      ready_begin_ = 0;
      ready_.resize(inflate(ready_.data(), kReady));
      done += takeReady(data + done, size - done);
    }
    else
      done += inflate(data + done, size - done);
  }
  if (with_checksum_) checksum_ = crc32With(checksum_, data, done);
  return done;
}

std::size_t StretchBytes::takeReady(std::uint8_t* data, std::size_t size)
{
  const std::size_t count = std::min(size, ready_.size() - ready_begin_);
  std::copy_n(ready_.begin() + static_cast<std::ptrdiff_t>(ready_begin_), count, data);
  ready_begin_ += count;
  return count;
}

std::optional<std::uint32_t> StretchBytes::checksum() const
{
  if (skipped_ || !with_checksum_) return std::nullopt;
  return checksum_;
}

bool StretchBytes::skip(std::uint64_t size)
{
  if (inflater_) return ByteSource::skip(size);
  const std::uint64_t wanted = std::min(size, left_);
  left_ -= wanted;
  skipped_ = true;
  truncated_ |= !file_.skip(wanted);
  return wanted == size && !truncated_;
}

std::string headOf(const std::string& path, std::size_t size)
{
  if (inputFileProblem(path)) return {};
  try
  {
    FileBytes file(path);
    std::string head(size, '\0');
    head.resize(file.read(reinterpret_cast<std::uint8_t*>(head.data()), size));
    return head;
  }
  catch (const std::runtime_error&)
  {
    return {};  // whoever opens it says why
  }
}

}  // namespace fastlio
