// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/recordings/inflater.h>

#include <new>
#include <zlib.h>

namespace fastlio
{
namespace
{
constexpr int kGzipFormat = 16;  // added to the size of the window

class ZlibInflater : public Inflater
{
 public:
  ZlibInflater()
  {
    if (inflateInit2(&stream_, kGzipFormat + MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~ZlibInflater() override { inflateEnd(&stream_); }

  void reset() override { inflateReset(&stream_); }

  InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) override
  {
    stream_.next_in = const_cast<Bytef*>(input);  // which zlib does not write to
    stream_.avail_in = input_size;
    stream_.next_out = output;
    stream_.avail_out = output_size;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    InflateStep step;
    step.consumed = input_size - stream_.avail_in;
    step.produced = output_size - stream_.avail_out;
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

std::unique_ptr<Inflater> makeZlibInflater()
{
  return std::make_unique<ZlibInflater>();
}

}  // namespace fastlio
