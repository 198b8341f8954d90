// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recordings_folder.h The recordings of the folder MRPT_FASTLIO_RECORDINGS_DIR. */
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace fastlio::testing
{
/** NAME of every NAME.rawlog that has a NAME.gt.tum beside it. */
inline std::vector<std::string> recordingNames()
{
  std::vector<std::string> names;
  const std::filesystem::path folder = MRPT_FASTLIO_RECORDINGS_DIR;
  if (folder.empty() || !std::filesystem::is_directory(folder)) return names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".rawlog" &&
        std::filesystem::exists(folder / (name + ".gt.tum")))
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/** A folder that goes with the test. */
class ScratchFolder
{
 public:
  explicit ScratchFolder(const std::string& name)
      : path_(
            std::filesystem::temp_directory_path() /
            ("fastlio-recordings-" + name + "-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace fastlio::testing
