// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file folder_lock.h One run at a time writes into a folder. */
#pragma once

#include <fastlio/files/file_descriptor.h>

#include <string>

namespace fastlio
{
/** Holds a folder for this process. The system gives it free when the process ends, however it
 * ends; the file `.fastlio-lock` in the folder names the process to others, and goes in the end. */
class FolderLock
{
 public:
  /** \exception std::runtime_error another process holds the folder (the message says which), or
   * the lock file cannot be written */
  explicit FolderLock(const std::string& directory);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /** Whether an earlier process was killed while it held the folder: its lock file was there. */
  [[nodiscard]] bool tookOver() const { return took_over_; }

 private:
  std::string path_;
  FileDescriptor file_;
  bool took_over_ = false;
};

/** Whether a process that holds the folder, or was killed while it did, has left its lock file. */
[[nodiscard]] bool hasLockFile(const std::string& directory);

}  // namespace fastlio
