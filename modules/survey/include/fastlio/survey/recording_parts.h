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

/** Joins files that follow each other in time: the same LiDARs and IMUs (label and class), and the
 * next one begins within a second of the end of the one before. Everything else stays alone.
 *
 * Only files of which another one may be the continuation are read to their end. Never throws for
 * what the files contain; what cannot be read (or only once, as a pipe) stays alone.
 * \param files recordings of any format, in any order
 * \return in the order of the first file of each */
[[nodiscard]] std::vector<RecordingParts> joinParts(const std::vector<std::string>& files);

/** Each file is a recording of its own. */
[[nodiscard]] std::vector<RecordingParts> withoutJoining(const std::vector<std::string>& files);

/** A sentence for people on what has been joined; empty: nothing. */
[[nodiscard]] std::string describe(const RecordingParts& recording);

}  // namespace fastlio
