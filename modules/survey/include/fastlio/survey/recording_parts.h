// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_parts.h Which of several files are parts of one recording. */
#pragma once

#include <string>
#include <vector>

namespace fastlio
{
/** The parts of one recording, in the order of their stamps. */
struct RecordingParts
{
  std::vector<std::string> files;   //!< at least one
  std::vector<double> pauses = {};  //!< between a part and the next one [s]; negative: they overlap
};

/** How several files become recordings. */
enum class Joining
{
  /** Files that follow each other in time are one: the same LiDARs and IMUs (label and class), and
   * the next one begins within a second of the end of the one before. Everything else stays alone,
   * and so does what cannot be read (or only once, as a pipe). Only files of which another one may
   * be the continuation are read to their end. */
  ByStamps,
  Always,  //!< all are parts of one recording, in this order
  Never    //!< each is a recording of its own
};

/** Never throws for what the files contain, unless they are joined always.
 * \param files recordings of any format; in any order, unless they are joined always
 * \return in the order of the first file of each
 * \exception std::invalid_argument files that are joined always are not in the order of time, or
 * overlap by more than the last sensors of a file that is cut by bytes do; names both and the
 * overlap */
[[nodiscard]] std::vector<RecordingParts> partsOf(
    const std::vector<std::string>& files, Joining joining);

/** Checks that each file begins where the one before ends. Files that cannot be read, or only once,
 * are left out. \exception std::invalid_argument as partsOf() */
void requireInOrder(const std::vector<std::string>& files);

/** A sentence for people on what has been joined; empty: nothing. */
[[nodiscard]] std::string describe(const RecordingParts& recording);

}  // namespace fastlio
