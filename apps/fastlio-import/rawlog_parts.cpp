// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rawlog_parts.h"

#include <fastlio/files/gzip_file.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/core/format.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <zstd.h>

namespace fastlio
{
namespace
{
/** As AtomicFile, compressed by Zstandard. */
class ZstdFile
{
 public:
  explicit ZstdFile(const std::string& path)
      : file_(path),
        context_(ZSTD_createCCtx(), ZSTD_freeCCtx),
        buffer_(ZSTD_CStreamOutSize(), '\0')
  {
    if (!context_) throw std::bad_alloc();
    ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_checksumFlag, 1);
  }

  void write(std::string_view bytes) { compress(bytes, ZSTD_e_continue); }

  OutputFile commit()
  {
    compress({}, ZSTD_e_end);
    return file_.commit();
  }

 private:
  void compress(std::string_view bytes, ZSTD_EndDirective mode)
  {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (bool done = false; !done;)
    {
      ZSTD_outBuffer out{buffer_.data(), buffer_.size(), 0};
      const std::size_t left = ZSTD_compressStream2(context_.get(), &out, &in, mode);
      if (ZSTD_isError(left) != 0)
        throw std::runtime_error(std::string("cannot compress: ") + ZSTD_getErrorName(left));
      file_.write({buffer_.data(), out.pos});
      done = mode == ZSTD_e_end ? left == 0 : in.pos == in.size;
    }
  }

  AtomicFile file_;
  std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context_;
  std::string buffer_;
};

template <typename File>
class RawlogIn : public RawlogFile
{
 public:
  explicit RawlogIn(const std::string& path) : file_(path) {}
  void write(std::string_view bytes) override { file_.write(bytes); }
  OutputFile commit() override { return file_.commit(); }

 private:
  File file_;
};

std::unique_ptr<RawlogFile> openRawlog(const std::string& path, RawlogCompression compression)
{
  switch (compression)
  {
    case RawlogCompression::None:
      return std::make_unique<RawlogIn<AtomicFile>>(path);
    case RawlogCompression::Gzip:
      return std::make_unique<RawlogIn<GzipFile>>(path);
    case RawlogCompression::Zstd:
      return std::make_unique<RawlogIn<ZstdFile>>(path);
  }
  throw std::logic_error("an unknown compression");
}
}  // namespace

std::string RawlogParts::pathOfPart(const Options& options, std::size_t part)
{
  if (options.split_mib <= 0 && options.split_seconds <= 0) return options.path;
  const std::filesystem::path path(options.path);
  const std::string name = path.stem().string() + mrpt::format("_%03zu", part + 1);
  return (path.parent_path() / (name + path.extension().string())).string();
}

std::optional<std::size_t> RawlogParts::partOf(const Options& options, const std::string& file_name)
{
  const std::string stem = std::filesystem::path(file_name).stem().string();
  const auto number = parsed<std::size_t>(std::string_view(stem).substr(stem.rfind('_') + 1));
  const std::size_t part = number && *number > 0 ? *number - 1 : 0;
  const bool is_part = std::filesystem::path(pathOfPart(options, part)).filename() == file_name;
  return is_part ? std::optional<std::size_t>(part) : std::nullopt;
}

bool RawlogParts::isFull(std::int64_t stamp_ns) const
{
  constexpr double kMib = 1024.0 * 1024.0;
  if (!file_) return false;
  if (options_.split_mib > 0 && static_cast<double>(bytes_) >= options_.split_mib * kMib)
    return true;
  return options_.split_seconds > 0 &&
         stamp_ns - first_ns_ >= toNanoseconds(options_.split_seconds);
}

bool RawlogParts::write(const mrpt::obs::CObservation& observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  if (isFull(stamp_ns)) close();
  if (!file_)
  {
    file_ = openRawlog(pathOfPart(options_, files_.size()), options_.compression);
    first_ns_ = stamp_ns;
    bytes_ = 0;
  }
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream).WriteObject(observation);
  file_->write(
      {static_cast<const char*>(stream.getRawBufferData()),
       static_cast<std::size_t>(stream.getTotalBytesCount())});
  bytes_ += stream.getTotalBytesCount();
  return true;
}

void RawlogParts::close()
{
  files_.push_back(file_->commit());
  file_.reset();
}

std::vector<OutputFile> RawlogParts::finish()
{
  if (file_) close();
  return files_;
}

}  // namespace fastlio
