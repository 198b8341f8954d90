// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file same_file.h Whether two paths lead to one file, so that no output destroys an input. */
#pragma once

#include <string>
#include <vector>

namespace fastlio
{
/** A file and what it is to the user, for example "--input-rawlog". */
struct FileUse
{
  std::string path;  //!< empty: there is none
  std::string role;
};

/** The path with the symbolic links of its last element followed, also where they lead to nothing.
 * \exception std::runtime_error the links go round in circles */
[[nodiscard]] std::string withLinksFollowed(const std::string& path);

/** Whether both paths lead to the same file: device and inode of files that are there (hard and
 * symbolic links), the canonical path of those that are not yet. Devices are not files, and neither
 * is an empty path. */
[[nodiscard]] bool isSameFile(const std::string& a, const std::string& b);

/** Whether the path leads to something below the folder. */
[[nodiscard]] bool isBelow(const std::string& path, const std::string& folder);

/** \exception std::invalid_argument two of the \a inputs are the same file;
 * the message names both */
void requireGivenOnce(const std::vector<std::string>& inputs);

/** For what counts each recording as new evidence.
 * \exception std::invalid_argument two of the \a inputs are the same file, or a file and its copy;
 * the message names both */
void requireDifferentRecordings(const std::vector<std::string>& inputs);

/** \exception std::invalid_argument an output is the same file as an input or as another output, and
 * the message names both; or it is "-", which looks like the standard output */
void requireDistinctFiles(const std::vector<FileUse>& inputs, const std::vector<FileUse>& outputs);

}  // namespace fastlio
