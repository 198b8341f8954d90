// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/gzip_file.h>

#include <array>
#include <stdexcept>
#include <zlib.h>

namespace fastlio
{
namespace
{
constexpr int kFastestCompression = 1;
constexpr int kGzipWindow = 15 + 16;  // zlib's largest window, with a gzip header
constexpr int kMemoryLevel = 8;
constexpr std::size_t kBuffer = 1U << 16U;
}  // namespace

struct GzipFile::Zlib
{
  z_stream stream = {};
  std::array<char, kBuffer> out{};
};

GzipFile::GzipFile(const std::string& path) : file_(path), zlib_(std::make_unique<Zlib>())
{
  if (deflateInit2(
          &zlib_->stream, kFastestCompression, Z_DEFLATED, kGzipWindow, kMemoryLevel,
          Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("cannot compress '" + path + "': is there enough memory?");
}

GzipFile::~GzipFile()
{
  deflateEnd(&zlib_->stream);
}

void GzipFile::deflate(int flush)
{
  z_stream& stream = zlib_->stream;
  do
  {
    stream.next_out = reinterpret_cast<Bytef*>(zlib_->out.data());
    stream.avail_out = kBuffer;
    ::deflate(&stream, flush);
    file_.write({zlib_->out.data(), kBuffer - stream.avail_out});
  } while (stream.avail_out == 0);
}

std::size_t GzipFile::Write(const void* data, std::size_t size)
{
  constexpr std::size_t kMost = 1U << 30U;  // zlib counts with 32 bits
  const auto* bytes = static_cast<const Bytef*>(data);
  for (std::size_t done = 0; done < size;)
  {
    const std::size_t count = std::min(kMost, size - done);
    zlib_->stream.next_in = const_cast<Bytef*>(bytes + done);
    zlib_->stream.avail_in = static_cast<uInt>(count);
    deflate(Z_NO_FLUSH);
    done += count;
  }
  return size;
}

std::size_t GzipFile::Read(void* /*data*/, std::size_t /*size*/)
{
  throw std::logic_error("GzipFile is for writing.");
}

OutputFile GzipFile::commit()
{
  zlib_->stream.avail_in = 0;
  deflate(Z_FINISH);
  return file_.commit();
}

}  // namespace fastlio
