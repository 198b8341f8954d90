// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/scratch_folder.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

constexpr std::string_view kUnique = "XXXXXX";  // for mkdtemp
constexpr const char* kNameOfFile = "0123456789-_";

struct Words
{
  std::string_view folder;  // its name begins so
  const char* content;
  const char* option;  // that allows more memory
};

constexpr std::array<Words, 2> kWords = {{
    {"map-tiles-", "pieces of the map that is saved", "output.map_memory"},
    {"map-submaps-", "planes of submaps", "output.submap_memory"},
}};

const Words& wordsOf(ScratchContent content)
{
  return kWords.at(static_cast<std::size_t>(content));
}

std::string remedyOf(const Words& words)
{
  return "; check permissions and free space, or allow more memory (" + std::string(words.option) +
         ")";
}

/** What the system says about the last call that failed. */
std::string reason()
{
  return errno == 0 ? "the system gives no reason" : std::generic_category().message(errno);
}

/** Of columns one after the other. */
std::size_t joined(std::size_t hash, std::string_view column)
{
  constexpr std::size_t kFactor = 31;
  return kFactor * hash + std::hash<std::string_view>{}(column);
}
}  // namespace

ScratchFolder::ScratchFolder(ScratchContent content, std::string directory)
    : content_(content), directory_(std::move(directory))
{
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

void ScratchFolder::make()
{
  const Words& words = wordsOf(content_);
  const fs::path place = directory_.empty() ? fs::temp_directory_path() : fs::path(directory_);
  std::string name = (place / words.folder).string().append(kUnique);
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(
        "cannot make the folder '" + name + "' for " + words.content + ": " + reason() +
        remedyOf(words));
  path_ = name;
}

ScratchFile ScratchFolder::writeBytes(
    const std::string& name, std::initializer_list<std::string_view> columns)
{
  if (path_.empty()) make();
  ScratchFile file{(fs::path(path_) / name).string()};
  errno = 0;
  std::ofstream out(file.path, std::ios::binary | std::ios::trunc);
  for (const std::string_view column : columns)
  {
    out.write(column.data(), static_cast<std::streamsize>(column.size()));
    file.hash = joined(file.hash, column);
  }
  out.close();
  if (out) return file;
  const Words& words = wordsOf(content_);
  const std::string why = reason();
  remove(file);  // half a file is of no use, and the disk may be full
  throw std::runtime_error(
      "cannot write '" + file.path + "' for " + words.content + ": " + why + remedyOf(words));
}

void ScratchFolder::readBytes(const ScratchFile& file, std::initializer_list<Target> columns) const
{
  std::ifstream in(file.path, std::ios::binary);
  std::size_t hash = 0;
  for (const Target& column : columns)
  {
    in.read(column.data, static_cast<std::streamsize>(column.size));
    hash = joined(hash, {column.data, column.size});
  }
  if (!in || hash != file.hash)
    throw std::runtime_error(
        "cannot read '" + file.path + "' (" + wordsOf(content_).content +
        "): was it removed or changed? Leave the folder alone while the program runs, or allow "
        "more memory (" +
        wordsOf(content_).option + ")");
}

void ScratchFolder::remove(const ScratchFile& file)
{
  std::error_code ignored;
  fs::remove(file.path, ignored);
}

bool isScratchFolder(const std::string& path)
{
  const std::string name = fs::path(path).filename().string();
  const auto is_of = [&name](const Words& words) {
    return name.size() == words.folder.size() + kUnique.size() && name.rfind(words.folder, 0) == 0;
  };
  std::error_code error;
  if (std::none_of(kWords.begin(), kWords.end(), is_of) ||
      !fs::is_directory(fs::symlink_status(path, error)))
    return false;
  const auto is_ours = [](const fs::directory_entry& entry)
  {
    std::error_code ignored;
    return fs::is_regular_file(entry.symlink_status(ignored)) &&
           entry.path().filename().string().find_first_not_of(kNameOfFile) == std::string::npos;
  };
  fs::directory_iterator at(path, error);
  while (!error && at != fs::directory_iterator() && is_ours(*at))
    at.increment(error);
  return !error && at == fs::directory_iterator();
}

}  // namespace fastlio
