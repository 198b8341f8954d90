// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "write_failure.h"
#include <fastlio/files/made_folders.h>

#include <cerrno>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

constexpr mode_t kNewFolder = 0777;  // the umask takes from it

/** The folder and its parents that are not there, from the outside to the inside. */
std::vector<std::string> missingFolders(const std::string& directory)
{
  std::vector<std::string> missing;
  std::error_code error;
  fs::path at = fs::absolute(directory, error).lexically_normal();
  if (!at.has_filename()) at = at.parent_path();  // "a/b/" is "a/b"
  for (; !at.empty() && !fs::exists(at, error) && at != at.parent_path(); at = at.parent_path())
    missing.insert(missing.begin(), at.string());
  return missing;
}

void requireEntry(const std::string& folder, const std::string& directory)
{
  std::error_code error;
  if (!fs::is_directory(folder, error)) failWriting(directory, "'" + folder + "' is no folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0) failWriting(directory);
}
}  // namespace

MadeFolders::MadeFolders(const std::string& directory)
{
  for (const std::string& folder : missingFolders(directory))
  {
    if (mkdir(folder.c_str(), kNewFolder) == 0)
    {
      made_.push_back(folder);
      continue;
    }
    if (errno == EEXIST) continue;  // another process was faster
    const int reason = errno;
    removeEmpty();
    errno = reason;
    failWriting(directory);
  }
  requireEntry(directory, directory);
}

MadeFolders::~MadeFolders()
{
  removeEmpty();
}

MadeFolders& MadeFolders::operator=(MadeFolders&& other) noexcept
{
  std::swap(made_, other.made_);
  return *this;
}

void MadeFolders::removeEmpty()
{
  for (; !made_.empty(); made_.pop_back())
    if (rmdir(made_.back().c_str()) != 0) break;
  made_.clear();
}

void requireWritableFolder(const std::string& directory)
{
  const std::vector<std::string> missing = missingFolders(directory);
  requireEntry(
      missing.empty() ? directory : fs::path(missing.front()).parent_path().string(), directory);
}

}  // namespace fastlio
