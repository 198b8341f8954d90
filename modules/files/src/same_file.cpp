// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "write_failure.h"
#include <fastlio/files/same_file.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <sys/stat.h>
#include <utility>
#include <variant>

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

/** Device and inode of a file that is there, the place of one that is not. */
using Identity = std::variant<std::pair<dev_t, ino_t>, fs::path>;

/** Nothing for a device that swallows everything: it is never the same file. */
std::optional<Identity> identityOf(const std::string& path)
{
  struct stat status = {};
  if (stat(path.c_str(), &status) != 0) return canonicalPath(path);
  if (S_ISCHR(status.st_mode)) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

/** Of files of the same size. */
bool hasSameBytes(const std::string& a, const std::string& b)
{
  constexpr std::size_t kChunk = 1 << 16;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  std::vector<char> from_first(kChunk), from_second(kChunk);
  while (first && second)
  {
    first.read(from_first.data(), kChunk);
    second.read(from_second.data(), kChunk);
    if (first.gcount() != second.gcount() ||
        !std::equal(from_first.begin(), from_first.begin() + first.gcount(), from_second.begin()))
      return false;
  }
  return first.eof() && second.eof();
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
  std::error_code ignored;
  if (a.empty() || b.empty()) return false;
  if (fs::exists(a, ignored) != fs::exists(b, ignored)) return false;
  const auto identity = identityOf(a);
  return identity && identity == identityOf(b);
}

bool isBelow(const std::string& path, const std::string& folder)
{
  const fs::path inner = canonicalPath(path).lexically_relative(canonicalPath(folder));
  return !inner.empty() && *inner.begin() != "..";
}

void requireGivenOnce(const std::vector<std::string>& inputs)
{
  // Looked up once each: the place of a file that is missing takes a walk through its folders.
  std::map<Identity, std::string> given;
  for (const std::string& input : inputs)
  {
    std::error_code error;
    if (fs::status(input, error).type() == fs::file_type::none) continue;  // reading says why
    const auto identity = identityOf(input);
    if (!identity) continue;
    const auto [first, is_new] = given.emplace(*identity, input);
    if (!is_new)
      throw std::invalid_argument(
          "input file '" + input + "' is given twice, first as '" + first->second +
          "'; give each recording once");
  }
}

void requireDifferentRecordings(const std::vector<std::string>& inputs)
{
  requireGivenOnce(inputs);
  std::multimap<std::uintmax_t, std::string> by_size;
  for (const std::string& input : inputs)
  {
    std::error_code error;
    if (!fs::is_regular_file(input, error)) continue;
    const std::uintmax_t size = fs::file_size(input, error);
    if (error || size == 0) continue;  // reading says why
    const auto [first, last] = by_size.equal_range(size);
    for (auto other = first; other != last; ++other)
      if (hasSameBytes(input, other->second))
        throw std::invalid_argument(
            "input file '" + input + "' is a copy of '" + other->second +
            "', which would count twice; give each recording once");
    by_size.emplace(size, input);
  }
}

void requireDistinctFiles(const std::vector<FileUse>& inputs, const std::vector<FileUse>& outputs)
{
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    // Many programs mean the standard output by it: a file of this name would surprise.
    if (outputs[i].path == "-")
      throw std::invalid_argument(
          outputs[i].role +
          ": '-' is no name of an output here; give './-' for one of that name. A file may also be "
          "/dev/stdout");
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
