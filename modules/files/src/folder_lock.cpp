// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "write_failure.h"
#include <fastlio/files/folder_lock.h>

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fastlio
{
namespace
{
constexpr const char* kLockFile = ".fastlio-lock";
constexpr mode_t kNewLockFile = 0666;  // the umask takes from it

std::string lockPath(const std::string& directory)
{
  return (std::filesystem::path(directory) / kLockFile).string();
}

std::string holderOf(int file)
{
  std::array<char, 16> text{};
  const ssize_t count = pread(file, text.data(), text.size(), 0);
  std::string digits(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  digits.resize(std::min(digits.size(), digits.find_first_not_of("0123456789")));
  return digits.empty() ? "another process" : "process " + digits;
}

/** False: the file was removed by the one who held it before. */
bool isStillThere(int file, const std::string& path)
{
  struct stat held = {}, named = {};
  return fstat(file, &held) == 0 && lstat(path.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

/** The content of a lock file is replaced, and the file goes in the end.
 * \exception std::runtime_error it is something else */
void requireLockFile(int file, const std::string& path)
{
  struct stat state = {};
  if (fstat(file, &state) == 0 && S_ISREG(state.st_mode) && state.st_nlink <= 1) return;
  throw std::runtime_error(
      "'" + path +
      "' is no lock file of a run: it is a pipe, a device or a file with several "
      "names; remove it or choose another folder");
}

/** An open file that this process holds. */
FileDescriptor heldFile(const std::string& directory, const std::string& path)
{
  constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  for (;;)
  {
    FileDescriptor file(open(path.c_str(), kFlags, kNewLockFile));
    if (!file.isOpen()) failWriting(path);
    requireLockFile(file.get(), path);
    // On a file system without locks nobody can be kept out.
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw std::runtime_error(
          "another run (" + holderOf(file.get()) + ") is writing into '" + directory +
          "'; wait for its end or choose another folder");
    if (isStillThere(file.get(), path)) return file;
  }
}
}  // namespace

FolderLock::FolderLock(const std::string& directory)
    : path_(lockPath(directory)), file_(heldFile(directory, path_))
{
  struct stat state = {};
  took_over_ = fstat(file_.get(), &state) == 0 && state.st_size > 0;
  const std::string pid = std::to_string(getpid()) + "\n";
  if (ftruncate(file_.get(), 0) == 0 &&
      pwrite(file_.get(), pid.data(), pid.size(), 0) == static_cast<ssize_t>(pid.size()))
    return;
  const int reason = errno;
  unlink(path_.c_str());
  errno = reason;
  failWriting(path_);
}

FolderLock::~FolderLock()
{
  unlink(path_.c_str());  // before it is given free, so that nobody else's goes
}

bool hasLockFile(const std::string& directory)
{
  std::error_code error;
  return std::filesystem::exists(lockPath(directory), error);
}

}  // namespace fastlio
