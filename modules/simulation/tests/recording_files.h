// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_files.h Where tests write recordings, and what they read there. */
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <unistd.h>

namespace fastlio::testing
{
inline std::string contentOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/** The files of a folder, with their content. */
inline std::map<std::string, std::string> filesIn(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename()] = contentOf(entry.path());
  return files;
}

/** A directory that is removed again. */
class TemporaryDirectory
{
 public:
  TemporaryDirectory()
      : path_(
            std::filesystem::temp_directory_path() /
            ("simulation_test_" + std::to_string(::getpid()) + "_" + std::to_string(++count)))
  {
  }
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  static inline int count = 0;
  std::filesystem::path path_;
};

}  // namespace fastlio::testing
