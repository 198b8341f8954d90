// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FASTLIO_WITH_ISAL

#include "gzip_deflater.h"

#include <new>
#include <zlib.h>

namespace fastlio
{
struct GzipDeflater::Library
{
  z_stream stream = {};
};

GzipDeflater::GzipDeflater() : library_(std::make_unique<Library>())
{
  constexpr int kFastest = 1;
  constexpr int kGzipWindow = 15 + 16;  // zlib's largest window, with a gzip header
  constexpr int kMemoryLevel = 8;
  if (deflateInit2(
          &library_->stream, kFastest, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
}

GzipDeflater::~GzipDeflater()
{
  deflateEnd(&library_->stream);
}

std::string_view GzipDeflater::deflate(std::string_view& input, bool end)
{
  z_stream& stream = library_->stream;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(input.data()));  // not written to
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(output_.data());
  stream.avail_out = kMostAtATime;
  ::deflate(&stream, end ? Z_FINISH : Z_NO_FLUSH);
  input.remove_prefix(input.size() - stream.avail_in);
  return {output_.data(), kMostAtATime - stream.avail_out};
}

}  // namespace fastlio

#endif
