// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "inflating_file.h"

#include <algorithm>
#include <stdexcept>
#include <zlib.h>

namespace
{
// Small, since what zlib has decompressed but not handed over is lost when it meets corrupt data.
constexpr unsigned kBufferBytes = 1U << 13U;
constexpr std::size_t kLargestRead = kBufferBytes;

gzFile handle(void* file)
{
  return static_cast<gzFile>(file);
}

fastlio::FileEnd endOf(void* file)
{
  int error = Z_OK;
  gzerror(handle(file), &error);
  if (error == Z_OK || error == Z_STREAM_END) return fastlio::FileEnd::Clean;
  return error == Z_BUF_ERROR ? fastlio::FileEnd::Truncated : fastlio::FileEnd::Corrupt;
}
}  // namespace

namespace fastlio
{
void InflatingFile::Closer::operator()(void* file) const
{
  gzclose_r(handle(file));
}

InflatingFile::InflatingFile(const std::string& path) : file_(gzopen(path.c_str(), "rb"))
{
  if (!file_) throw std::runtime_error("cannot be opened");
  gzbuffer(handle(file_.get()), kBufferBytes);
}

std::size_t InflatingFile::read(char* data, std::size_t size)
{
  std::size_t done = 0;
  while (done < size && end_ == FileEnd::NotYet)
  {
    const auto wanted = static_cast<unsigned>(std::min(size - done, kLargestRead));
    const int got = gzread(handle(file_.get()), data + done, wanted);
    if (got > 0) done += static_cast<std::size_t>(got);
    if (got < 0 || static_cast<unsigned>(got) < wanted) end_ = endOf(file_.get());
  }
  return done;
}

std::uint64_t InflatingFile::compressedPosition() const
{
  const auto offset = gzoffset(handle(file_.get()));
  return offset < 0 ? 0 : static_cast<std::uint64_t>(offset);
}

}  // namespace fastlio
