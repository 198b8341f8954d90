// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rawlog_source.h Observations out of recordings, in order of time, without ever hiding
 * trouble. */
#pragma once

#include <fastlio/recordings/read_problem.h>

#include <mrpt/obs/CObservation.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace fastlio
{
/** How far reading has come, for progress bars. */
struct ReadProgress
{
  std::uint64_t bytes_read = 0;  //!< of the files as they lie on disk
  std::uint64_t bytes_total = 0;

  /** The part that has been read, 0 to 1. */
  [[nodiscard]] double share() const
  {
    return bytes_total > 0 ? static_cast<double>(bytes_read) / static_cast<double>(bytes_total)
                           : 0.0;
  }
};

struct RawlogSourceOptions
{
  /** Observations that arrive late by up to this are put in order of their stamps [s]; later ones
   * are delivered as they come. */
  double sorting_window = 0.2;
};

/** Reads one or more recordings in the order given: rawlogs, plain or compressed, streams of
 * observations or action/sensory-frame rawlogs (frames are taken apart, actions skipped), and the
 * formats of recordingFormats(). The content of a file determines its format.
 *
 * next() does not throw for anything that the files contain: what cannot be read ends up in
 * problems() and everything else is delivered; behind an object that cannot be decoded reading goes
 * on at the next one that can be found. Not thread-safe; see DecodeAheadSource for reading
 * on a thread. */
class RawlogSource
{
 public:
  /** Files are opened when their turn comes.
   * \exception std::invalid_argument no files, or a negative sorting window */
  explicit RawlogSource(std::vector<std::string> files, RawlogSourceOptions options = {});
  ~RawlogSource();
  RawlogSource(RawlogSource&&) noexcept;
  RawlogSource& operator=(RawlogSource&&) noexcept;

  /** The next observation; null after the last one. */
  [[nodiscard]] mrpt::obs::CObservation::Ptr next();

  /** Everything that could not be read so far; complete once next() has returned null. */
  [[nodiscard]] const std::vector<ReadProblem>& problems() const;

  [[nodiscard]] ReadProgress progress() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastlio
