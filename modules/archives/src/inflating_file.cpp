// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/archives/inflating_file.h>

#include <limits>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::string_view kGzipMagic = "\x1F\x8B";

/** Of the members of a file; empty: it is plain. */
std::string_view magicOf(const std::string& path)
{
  const std::string head = headOf(path, kZstdMagic.size());
  for (const std::string_view magic : {kGzipMagic, kZstdMagic})
    if (head.compare(0, magic.size(), magic) == 0) return magic;
  return {};
}

std::unique_ptr<Inflater> inflaterOf(std::string_view magic, std::unique_ptr<Inflater> for_gzip)
{
  if (magic == kGzipMagic) return for_gzip;
  return magic == kZstdMagic ? makeZstdInflater() : nullptr;
}
}  // namespace

std::unique_ptr<Inflater> InflatingFile::fastestInflater()
{
  auto inflater = makeIsalInflater();
  return inflater ? std::move(inflater) : makeZlibInflater();
}

// The stretch goes beyond the end: a file may grow while it is read.
InflatingFile::InflatingFile(const std::string& path, std::unique_ptr<Inflater> for_gzip)
    : file_(path),
      magic_(magicOf(path)),
      bytes_(
          file_, std::numeric_limits<std::uint64_t>::max(), inflaterOf(magic_, std::move(for_gzip)))
{
  bytes_.joinMembers(magic_);
}

std::size_t InflatingFile::read(char* data, std::size_t size)
{
  const std::size_t got = bytes_.read(reinterpret_cast<std::uint8_t*>(data), size);
  if (got == size) return got;
  if (bytes_.corrupt() || file_.failed())
    end_ = FileEnd::Corrupt;
  else
    end_ = bytes_.whole() ? FileEnd::Clean : FileEnd::Truncated;
  return got;
}

}  // namespace fastlio
