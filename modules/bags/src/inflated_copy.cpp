// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "inflated_copy.h"

#include <fastlio/recordings/byte_source.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace fastlio
{
namespace
{
// Recordings of sensors shrink to a half or a third.
constexpr std::uint64_t kMostGrowth = 50;
constexpr std::size_t kCopyPiece = std::size_t{1} << 18U;

[[noreturn]] void failWriting(int error)
{
  throw std::runtime_error(
      std::string("cannot be inflated to the folder for temporary files: ") + std::strerror(error) +
      "; set TMPDIR to a folder with more room");
}

void copyInflated(FileBytes& file, std::FILE* to)
{
  const std::uint64_t most = kMostGrowth * file.size() + kLargestRecord;
  StretchBytes bytes(file, file.size(), makeZstdInflater());
  bytes.joinMembers();
  Bytes piece(kCopyPiece);
  for (std::uint64_t total = 0;;)
  {
    const std::size_t got = bytes.read(piece.data(), piece.size());
    if (std::fwrite(piece.data(), 1, got, to) != got) failWriting(errno);
    total += got;
    if (total > most) throw std::runtime_error("claims to inflate to more than 50 times its size");
    if (got < piece.size()) return;  // what is missing or damaged shows when it is read
  }
}
}  // namespace

InflatedCopy::InflatedCopy(const std::string& path)
{
  FileBytes file(path);
  path_ = (std::filesystem::temp_directory_path() / "fastlio-XXXXXX").string();
  const int descriptor = mkstemp(path_.data());
  std::FILE* to = descriptor < 0 ? nullptr : fdopen(descriptor, "wb");
  if (to == nullptr)
    throw std::runtime_error("cannot be inflated to '" + path_ + "': " + std::strerror(errno));
  try
  {
    copyInflated(file, to);
  }
  catch (const std::exception&)
  {
    std::fclose(to);
    unlink(path_.c_str());
    throw;
  }
  if (std::fclose(to) == 0) return;  // it writes the last bytes
  const int error = errno;
  unlink(path_.c_str());
  failWriting(error);
}

InflatedCopy::~InflatedCopy()
{
  unlink(path_.c_str());
}

std::string inflatedHeadOf(const std::string& path, std::size_t size)
{
  if (headOf(path, kZstdMagic.size()) != kZstdMagic) return {};
  try
  {
    FileBytes file(path);
    StretchBytes bytes(file, file.size(), makeZstdInflater());
    std::string head(size, '\0');
    head.resize(bytes.read(reinterpret_cast<std::uint8_t*>(head.data()), size));
    return head;
  }
  catch (const std::exception&)
  {
    return {};
  }
}

}  // namespace fastlio
