// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_names.h"

#include <fastlio/run/run_folder.h>

#include <filesystem>
#include <regex>
#include <system_error>
#include <unistd.h>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kLatest = "latest";

/** Whether freeRunFolder() could have named it: "walk-run", "walk-run-2". */
bool isNameOfRun(const std::string& name)
{
  static const std::regex pattern(".+-run(-[0-9]+)?");
  return fs::path(name).filename() == name && std::regex_match(name, pattern);
}

/** Whether "latest" leads to a run, or to one that was there. */
bool leadsToRun()
{
  std::error_code error;
  const std::string target = fs::read_symlink(kLatest, error).string();
  return fs::exists(target, error) ? holdsRun(target) : isNameOfRun(target);
}
}  // namespace

std::string recordingName(const std::string& path)
{
  fs::path name = fs::path(path).filename();
  if (name.empty()) name = fs::path(path).parent_path().filename();  // "folder/"
  for (const char* suffix : {".gz", ".zst", ".zstd"})
    if (name.extension() == suffix) name = name.stem();
  const std::string stem = name.stem().string();
  return stem.empty() || stem == "." || stem == ".." || stem == "-" ? "recording" : stem;
}

std::string firstFree(
    const std::string& first, const std::function<bool(const std::string&)>& is_taken)
{
  std::string name = first;
  for (int number = 2; is_taken(name); ++number)
    name = first + "-" + std::to_string(number);
  return name;
}

std::string freeRunFolder(const std::string& recording, const std::string& suffix)
{
  return firstFree(
      recordingName(recording) + suffix, [](const std::string& folder)
      { return fs::symlink_status(folder).type() != fs::file_type::not_found; });
}

std::optional<std::string> linkLatest(const std::string& folder)
{
  std::error_code error;
  const fs::file_type there = fs::symlink_status(kLatest, error).type();
  if (there != fs::file_type::not_found && there != fs::file_type::symlink)
    return "'latest' is no symbolic link: it stays as it is";
  if (there == fs::file_type::symlink && !leadsToRun())
    return "'latest' is a link to something that is no folder of a run: it stays as it is; remove "
           "it to have a link to '" +
           folder + "'";
  // A link gets its name when it is complete.
  const std::string temporary = std::string(".") + kLatest + "." + std::to_string(getpid());
  fs::create_directory_symlink(folder, temporary, error);
  if (!error) fs::rename(temporary, kLatest, error);
  if (!error) return std::nullopt;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return "'latest' cannot be made a link to '" + folder + "': " + error.message();
}

}  // namespace fastlio
