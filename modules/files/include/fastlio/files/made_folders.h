// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file made_folders.h A folder for outputs that does not outlive a run which wrote nothing. */
#pragma once

#include <string>
#include <vector>

namespace fastlio
{
/** Makes a folder and its parents; in the end those of them that are still empty go again. */
class MadeFolders
{
 public:
  MadeFolders() = default;
  /** \exception std::runtime_error the folder cannot be made, or no file can be made in it */
  explicit MadeFolders(const std::string& directory);
  ~MadeFolders();
  MadeFolders(MadeFolders&& other) noexcept = default;
  MadeFolders& operator=(MadeFolders&& other) noexcept;
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;

 private:
  void removeEmpty();

  std::vector<std::string> made_;  //!< from the outside to the inside
};

/** Checks that \a directory could be made and written, without making anything.
 * \exception std::runtime_error it could not */
void requireWritableFolder(const std::string& directory);

}  // namespace fastlio
