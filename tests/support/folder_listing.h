// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file folder_listing.h The content of a folder, to compare. */
#pragma once

#include "temporary_folder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** Names in alphabetical order, separated by blanks; empty when there is no such folder. */
inline std::string namesIn(const std::string& folder)
{
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : " ") + name;
  return text;
}

inline std::string namesIn(const TemporaryFolder& folder)
{
  return namesIn(folder.path());
}

/** The files of a folder, with their content. */
inline std::map<std::string, std::string> filesIn(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = contentOf(entry.path().string());
  return files;
}

}  // namespace fastlio::testing
