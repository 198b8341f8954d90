// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "gzip_inflater.h"

#include <algorithm>
#include <limits>
#include <new>
#include <zlib.h>

namespace fastlio
{
namespace
{
constexpr int kGzipFormat = 16;  // added to the size of the window

uInt clamped(std::size_t size)
{
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
}

class ZlibInflater : public GzipInflater
{
 public:
  ZlibInflater()
  {
    if (inflateInit2(&stream_, kGzipFormat + MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~ZlibInflater() override { inflateEnd(&stream_); }

  void reset() override { inflateReset(&stream_); }

  InflateStep step(
      const unsigned char* input, std::size_t input_size, unsigned char* output,
      std::size_t output_size) override
  {
    const uInt in = clamped(input_size), out = clamped(output_size);
    stream_.next_in = const_cast<Bytef*>(input);  // which zlib does not write to
    stream_.avail_in = in;
    stream_.next_out = output;
    stream_.avail_out = out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    InflateStep step;
    step.consumed = in - stream_.avail_in;
    step.produced = out - stream_.avail_out;
    if (result == Z_STREAM_END)
      step.status = InflateStatus::MemberEnd;
    else if (result != Z_OK && result != Z_BUF_ERROR)
      step.status = InflateStatus::Corrupt;
    return step;
  }

 private:
  z_stream stream_ = {};
};
}  // namespace

std::unique_ptr<GzipInflater> makeZlibInflater()
{
  return std::make_unique<ZlibInflater>();
}

}  // namespace fastlio
