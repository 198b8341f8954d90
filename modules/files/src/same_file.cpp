// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "write_failure.h"
#include <fastlio/files/same_file.h>

#include <filesystem>
#include <stdexcept>
#include <sys/stat.h>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the system

std::string described(const FileUse& file)
{
  return "'" + file.path + "' (" + file.role + ")";
}

fs::path canonicalPath(const std::string& path)
{
  std::error_code error;
  const fs::path absolute = fs::absolute(withLinksFollowed(path), error);
  const fs::path canonical = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}
}  // namespace

std::string withLinksFollowed(const std::string& path)
{
  fs::path at = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, error)); ++links)
  {
    if (links == kMostLinks) failWriting(path, "its symbolic links go round in circles");
    at = at.parent_path() / fs::read_symlink(at, error);  // an absolute one replaces all
  }
  return at.string();
}

bool isSameFile(const std::string& a, const std::string& b)
{
  struct stat of_a = {}, of_b = {};
  const bool a_exists = stat(a.c_str(), &of_a) == 0, b_exists = stat(b.c_str(), &of_b) == 0;
  if (a_exists && b_exists)
    return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino && !S_ISCHR(of_a.st_mode);
  return a_exists == b_exists && canonicalPath(a) == canonicalPath(b);
}

bool isBelow(const std::string& path, const std::string& folder)
{
  const fs::path inner = canonicalPath(path).lexically_relative(canonicalPath(folder));
  return !inner.empty() && *inner.begin() != "..";
}

void requireGivenOnce(const std::vector<std::string>& inputs)
{
  for (std::size_t i = 1; i < inputs.size(); ++i)
    for (std::size_t first = 0; first < i; ++first)
      if (isSameFile(inputs[first], inputs[i]))
        throw std::invalid_argument(
            "input file '" + inputs[i] + "' is given twice, first as '" + inputs[first] +
            "'; give each recording once");
}

void requireDistinctFiles(const std::vector<FileUse>& inputs, const std::vector<FileUse>& outputs)
{
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    for (const FileUse& input : inputs)
      if (isSameFile(input.path, outputs[i].path))
        throw std::invalid_argument(
            "the output " + described(outputs[i]) + " is the same file as the input " +
            described(input) + "; nothing was changed: choose another place for the output");
    for (std::size_t other = 0; other < i; ++other)
      if (isSameFile(outputs[other].path, outputs[i].path))
        throw std::invalid_argument(
            "the outputs " + described(outputs[other]) + " and " + described(outputs[i]) +
            " are the same file; nothing was changed: choose another place for one of them");
  }
}

}  // namespace fastlio
