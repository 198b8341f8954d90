// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "write_failure.h"
#include <fastlio/files/atomic_file.h>
#include <fastlio/files/same_file.h>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kUnwritten = 1U << 14U;
constexpr std::size_t kSuffixLength = 8;
constexpr std::string_view kSuffixEnd = ".tmp";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
constexpr mode_t kNewFile = 0666;  // the umask takes from it
constexpr mode_t kPermissions = 0777;

/** Nobody can put a file or a link of that name there beforehand. */
std::string unpredictableSuffix()
{
  std::random_device random;
  std::uniform_int_distribution<std::size_t> letter(0, kLetters.size() - 1);
  std::string suffix = ".";
  for (std::size_t i = 0; i < kSuffixLength; ++i)
    suffix += kLetters[letter(random)];
  return suffix.append(kSuffixEnd);
}

/** The descriptor of the process's own output when that is this file, else -1. */
int standardStreamOf(const struct stat& file)
{
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
  {
    struct stat own = {};
    if (fstat(stream, &own) == 0 && own.st_dev == file.st_dev && own.st_ino == file.st_ino)
      return stream;
  }
  return -1;
}

/** Pipes, terminals and some file systems have nothing to bring to a disk. */
bool hasNothingToSync(int error)
{
  return error == EINVAL || error == ENOTSUP || error == EROFS || error == ENOSYS;
}

bool synced(int file)
{
  int result = 0;
  do
    result = fsync(file);
  while (result != 0 && errno == EINTR);
  return result == 0 || hasNothingToSync(errno);
}

/** A new name lasts when its folder has reached the disk. */
bool folderSynced(const std::string& path)
{
  const auto folder = std::filesystem::path(path).parent_path();
  const FileDescriptor file(
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return !file.isOpen() || synced(file.get());  // it may be one that we may not read
}
}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path))
{
  buffer_.reserve(kUnwritten);
  struct stat existing = {};
  const bool exists = stat(path_.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) failWriting(path_, "it is a folder");
  if (exists && standardStreamOf(existing) >= 0)
    file_ = FileDescriptor(fcntl(standardStreamOf(existing), F_DUPFD_CLOEXEC, 0));
  else if (exists && !S_ISREG(existing.st_mode))
    openDirectly();
  else
    openTemporary(withLinksFollowed(path_));
  if (!file_.isOpen()) failWriting(path_);
  // A private file stays private.
  if (exists && !temporary_.empty()) (void)fchmod(file_.get(), existing.st_mode & kPermissions);
}

AtomicFile::~AtomicFile()
{
  file_.close();
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::openDirectly()
{
  do
    file_ = FileDescriptor(open(path_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
  while (!file_.isOpen() && errno == EINTR);
}

void AtomicFile::openTemporary(const std::string& target)
{
  target_ = target;
  // A rename would replace what may only be read.
  if (access(target.c_str(), W_OK) != 0 && errno != ENOENT) failWriting(path_);
  do
  {
    temporary_ = target + unpredictableSuffix();
    file_ = FileDescriptor(
        open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFile));
  } while (!file_.isOpen() && (errno == EEXIST || errno == EINTR));
  if (!file_.isOpen()) temporary_.clear();
}

void AtomicFile::write(std::string_view bytes)
{
  if (buffer_.size() + bytes.size() > kUnwritten) flush();
  if (bytes.size() > kUnwritten)
    writeThrough(bytes);
  else
    buffer_ += bytes;
}

void AtomicFile::flush()
{
  writeThrough(buffer_);
  buffer_.clear();
}

void AtomicFile::writeThrough(std::string_view bytes)
{
  while (!bytes.empty())
  {
    const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failWriting(path_);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    bytes_ += static_cast<std::uintmax_t>(count);
  }
}

void AtomicFile::overwrite(std::uintmax_t offset, std::string_view bytes)
{
  if (!isRewritable()) failWriting(path_, "a pipe or a device takes bytes in their order only");
  flush();
  if (offset > bytes_ || bytes.size() > bytes_ - offset)
    throw std::logic_error("AtomicFile: bytes that were not written yet cannot be replaced");
  while (!bytes.empty())
  {
    const ssize_t count =
        pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failWriting(path_);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    offset += static_cast<std::uintmax_t>(count);
  }
}

OutputFile AtomicFile::commit()
{
  flush();
  if (!synced(file_.get())) failWriting(path_);
  if (!file_.close()) failWriting(path_);
  if (!temporary_.empty()) rename();
  return {path_, bytes_};
}

void AtomicFile::rename()
{
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) failWriting(path_);
  temporary_.clear();
  if (!folderSynced(target_)) failWriting(path_);
}

OutputFile writeFileAtomically(const std::string& path, std::string_view content)
{
  AtomicFile file(path);
  file.write(content);
  return file.commit();
}

bool isTemporaryOf(std::string_view file, std::string_view name)
{
  const std::size_t suffix = 1 + kSuffixLength + kSuffixEnd.size();
  if (name.size() != file.size() + suffix || name.substr(0, file.size()) != file) return false;
  const std::string_view letters = name.substr(file.size() + 1, kSuffixLength);
  return name[file.size()] == '.' && name.substr(name.size() - kSuffixEnd.size()) == kSuffixEnd &&
         letters.find_first_not_of(kLetters) == std::string_view::npos;
}

}  // namespace fastlio
