// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file own_file.h Whether a file may be replaced, because the program wrote it itself. */
#pragma once

#include <string>

namespace fastlio
{
/** How a program recognises the files that it has written. */
struct OwnFile
{
  std::string program;    //!< its name
  std::string beginning;  //!< with which each of its files begins
};

/** Checks that nothing of somebody else would be replaced: \a path is not there yet, empty, no
 * regular file (a device), or it begins as the files of the program do.
 * \exception std::invalid_argument otherwise; the message names the file and --overwrite */
void requireOwnFile(const std::string& path, const OwnFile& own);

}  // namespace fastlio
