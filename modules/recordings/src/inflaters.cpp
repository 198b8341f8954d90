// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/recordings/inflater.h>

#include <bzlib.h>
#include <lz4frame.h>
#include <new>
#include <zstd.h>

namespace fastlio
{
namespace
{
// A power of two: what zstd itself takes without being asked for more. The data say how much they
// need.
constexpr int kLargestZstdWindow = 27;

class Bzip2Inflater : public Inflater
{
 public:
  Bzip2Inflater() { begin(); }
  ~Bzip2Inflater() override { BZ2_bzDecompressEnd(&stream_); }

  void reset() override
  {
    BZ2_bzDecompressEnd(&stream_);
    begin();
  }

  InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) override
  {
    stream_.next_in = const_cast<char*>(reinterpret_cast<const char*>(input));  // not written to
    stream_.avail_in = input_size;
    stream_.next_out = reinterpret_cast<char*>(output);
    stream_.avail_out = output_size;
    const int result = BZ2_bzDecompress(&stream_);
    InflateStep step;
    step.consumed = input_size - stream_.avail_in;
    step.produced = output_size - stream_.avail_out;
    if (result == BZ_STREAM_END)
      step.status = InflateStatus::MemberEnd;
    else if (result != BZ_OK)
      step.status = InflateStatus::Corrupt;
    return step;
  }

 private:
  void begin()
  {
    stream_ = {};
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }

  bz_stream stream_ = {};
};

class Lz4Inflater : public Inflater
{
 public:
  Lz4Inflater()
  {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION)) != 0)
      throw std::bad_alloc();
  }
  ~Lz4Inflater() override { LZ4F_freeDecompressionContext(context_); }

  void reset() override { LZ4F_resetDecompressionContext(context_); }

  InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) override
  {
    std::size_t consumed = input_size, produced = output_size;
    const std::size_t hint =
        LZ4F_decompress(context_, output, &produced, input, &consumed, nullptr);
    if (LZ4F_isError(hint) != 0) return {0, 0, InflateStatus::Corrupt};
    return {consumed, produced, hint == 0 ? InflateStatus::MemberEnd : InflateStatus::Going};
  }

 private:
  LZ4F_dctx* context_ = nullptr;
};

class ZstdInflater : public Inflater
{
 public:
  ZstdInflater() : stream_(ZSTD_createDStream())
  {
    if (stream_ == nullptr) throw std::bad_alloc();
    ZSTD_DCtx_setParameter(stream_, ZSTD_d_windowLogMax, kLargestZstdWindow);
  }
  ~ZstdInflater() override { ZSTD_freeDStream(stream_); }

  void reset() override { ZSTD_DCtx_reset(stream_, ZSTD_reset_session_only); }

  InflateStep step(
      const unsigned char* input, std::uint32_t input_size, unsigned char* output,
      std::uint32_t output_size) override
  {
    ZSTD_inBuffer in{input, input_size, 0};
    ZSTD_outBuffer out{output, output_size, 0};
    const std::size_t hint = ZSTD_decompressStream(stream_, &out, &in);
    if (ZSTD_isError(hint) != 0) return {in.pos, out.pos, InflateStatus::Corrupt};
    return {in.pos, out.pos, hint == 0 ? InflateStatus::MemberEnd : InflateStatus::Going};
  }

 private:
  ZSTD_DStream* stream_;
};
}  // namespace

std::unique_ptr<Inflater> makeBzip2Inflater()
{
  return std::make_unique<Bzip2Inflater>();
}

std::unique_ptr<Inflater> makeLz4Inflater()
{
  return std::make_unique<Lz4Inflater>();
}

std::unique_ptr<Inflater> makeZstdInflater()
{
  return std::make_unique<ZstdInflater>();
}

}  // namespace fastlio
