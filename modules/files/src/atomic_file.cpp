// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/atomic_file.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace fastlio
{
namespace
{
[[noreturn]] void failWriting(const std::string& path, const std::string& reason)
{
  throw std::runtime_error(
      "cannot write '" + path + "': " + reason +
      "; check that the folder exists, permissions and free space, or choose another place");
}

std::string lastError()
{
  return std::generic_category().message(errno);
}
}  // namespace

std::string temporaryPathOf(const std::string& path)
{
  return path + ".tmp";
}

OutputFile renameIntoPlace(const std::string& path)
{
  std::error_code error;
  std::filesystem::rename(temporaryPathOf(path), path, error);
  if (error) failWriting(path, error.message());
  const auto bytes = std::filesystem::file_size(path, error);
  return {path, error ? 0 : bytes};
}

void prepareOutputDirectory(const std::string& directory)
{
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) failWriting(directory, error.message());
  const auto probe = (std::filesystem::path(directory) / ".fastlio-write-test").string();
  std::ofstream(probe, std::ios::binary) << "x";
  if (!std::filesystem::remove(probe, error))
    failWriting(directory, "no file can be created in it");
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path))
{
  errno = 0;
  out_.open(temporaryPathOf(path_), std::ios::binary | std::ios::trunc);
  if (!out_) failWriting(temporaryPathOf(path_), lastError());
}

void AtomicFile::write(std::string_view bytes)
{
  errno = 0;
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out_) failWriting(temporaryPathOf(path_), lastError());
}

OutputFile AtomicFile::commit()
{
  errno = 0;
  out_.close();
  if (!out_) failWriting(temporaryPathOf(path_), lastError());
  return renameIntoPlace(path_);
}

OutputFile writeFileAtomically(const std::string& path, std::string_view content)
{
  AtomicFile file(path);
  file.write(content);
  return file.commit();
}

}  // namespace fastlio
