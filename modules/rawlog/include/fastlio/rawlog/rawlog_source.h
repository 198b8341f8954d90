// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rawlog_source.h Observations out of rawlog files, in order of time, without ever hiding
 * trouble. */
#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace fastlio
{
/** What went wrong while reading. */
enum class ReadProblemKind
{
  NotFound,      //!< no such file, or it cannot be opened
  NotARawlog,    //!< the content is something else, or empty
  Truncated,     //!< the file ends inside an object or inside the compressed data
  Corrupt,       //!< an object or the compressed data cannot be decoded
  UnknownClass,  //!< an object of a class that this MRPT does not know
  ExternalFile   //!< the data of an observation lie in another file that cannot be read
};

[[nodiscard]] const char* toString(ReadProblemKind kind);

/** One problem; the same kind with the same class in one file is reported once and counted. */
struct ReadProblem
{
  std::string file;
  std::size_t object_index = 0;   //!< of the object concerned, counted from 0 in its file
  std::uint64_t byte_offset = 0;  //!< where that object starts, in uncompressed bytes
  ReadProblemKind kind = ReadProblemKind::Corrupt;
  std::string class_name;  //!< class of the object; empty when unknown
  std::string message;     //!< what happened, where, and what to do
  std::size_t occurrences = 1;
};

/** How far reading has come, for progress bars. */
struct ReadProgress
{
  std::uint64_t bytes_read = 0;  //!< of the files as they lie on disk
  std::uint64_t bytes_total = 0;
  std::size_t objects_read = 0;
  std::size_t observations_read = 0;
};

struct RawlogSourceOptions
{
  /** Observations that arrive late by up to this are put in order of their stamps [s]; later ones
   * are delivered as they come. */
  double sorting_window = 0.2;

  /** Go on behind an object that cannot be decoded, at the next one that can be found. */
  bool recover = true;
};

/** Reads one or more rawlogs in the order given: plain or gzip, streams of observations or
 * action/sensory-frame rawlogs (frames are taken apart, actions skipped).
 *
 * next() does not throw for anything that the files contain: what cannot be read ends up in
 * problems() and everything else is delivered. Not thread-safe; see DecodeAheadSource for reading
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
