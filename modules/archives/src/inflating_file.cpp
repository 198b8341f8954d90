// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/archives/inflating_file.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace
{
constexpr std::size_t kBufferBytes = 1U << 16U;
constexpr std::size_t kLargestStep = 1U << 30U;  // what the libraries count fits 32 bits
constexpr std::string_view kGzipMagic = "\x1F\x8B";
}  // namespace

namespace fastlio
{
std::unique_ptr<Inflater> InflatingFile::fastestInflater()
{
  auto inflater = makeIsalInflater();
  return inflater ? std::move(inflater) : makeZlibInflater();
}

InflatingFile::InflatingFile(const std::string& path, std::unique_ptr<Inflater> for_gzip)
    : file_(std::fopen(path.c_str(), "rb")), buffer_(kBufferBytes)
{
  if (!file_) throw std::runtime_error("cannot be opened");
  if (startsWith(kGzipMagic))
  {
    magic_ = kGzipMagic;
    inflater_ = std::move(for_gzip);
  }
  else if (startsWith(kZstdMagic))
  {
    magic_ = kZstdMagic;
    inflater_ = makeZstdInflater();
  }
}

/** Fills the buffer up behind what is left in it. */
void InflatingFile::load()
{
  std::copy(
      buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_begin_),
      buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_end_), buffer_.begin());
  buffer_end_ = available();
  buffer_begin_ = 0;
  const std::size_t got =
      std::fread(buffer_.data() + buffer_end_, 1, buffer_.size() - buffer_end_, file_.get());
  buffer_end_ += got;
  loaded_ += got;
}

bool InflatingFile::startsWith(std::string_view magic)
{
  if (available() < magic.size()) load();
  return available() >= magic.size() &&
         std::memcmp(buffer_.data() + buffer_begin_, magic.data(), magic.size()) == 0;
}

std::size_t InflatingFile::readPlain(unsigned char* data, std::size_t size)
{
  if (available() == 0) load();
  const std::size_t count = std::min(size, available());
  std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_begin_), count, data);
  buffer_begin_ += count;
  if (count == 0) end_ = std::ferror(file_.get()) != 0 ? FileEnd::Corrupt : FileEnd::Clean;
  return count;
}

std::size_t InflatingFile::inflate(unsigned char* data, std::size_t size)
{
  if (available() == 0) load();
  const InflateStep step = inflater_->step(
      buffer_.data() + buffer_begin_, static_cast<std::uint32_t>(available()), data,
      static_cast<std::uint32_t>(std::min(size, kLargestStep)));
  buffer_begin_ += step.consumed;
  if (step.status == InflateStatus::Corrupt)
    end_ = FileEnd::Corrupt;
  else if (step.status == InflateStatus::MemberEnd && startsWith(magic_))
    inflater_->reset();
  else if (step.status == InflateStatus::MemberEnd)
    end_ = FileEnd::Clean;
  else if (step.consumed == 0 && step.produced == 0)
    end_ = std::ferror(file_.get()) != 0 || available() > 0 ? FileEnd::Corrupt : FileEnd::Truncated;
  return step.produced;
}

std::size_t InflatingFile::read(char* data, std::size_t size)
{
  auto* bytes = reinterpret_cast<unsigned char*>(data);
  std::size_t done = 0;
  while (done < size && end_ == FileEnd::NotYet)
    done += inflater_ ? inflate(bytes + done, size - done) : readPlain(bytes + done, size - done);
  return done;
}

}  // namespace fastlio
