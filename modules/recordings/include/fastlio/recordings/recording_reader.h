// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recording_reader.h Recordings of other makers: one reader per format. */
#pragma once

#include <fastlio/recordings/read_problem.h>

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace fastlio
{
/** No more observations, nothing wrong. */
struct EndOfRecording
{
};

/** An observation (never null), a problem, after which reading may go on, or the end. */
using NextRecorded = std::variant<mrpt::obs::CObservation::Ptr, ReadProblem, EndOfRecording>;

/** One topic, stream or folder of a recording. */
struct TopicReport
{
  std::string name;          //!< also the label of its observations
  std::string type;          //!< as the recording calls it
  std::size_t messages = 0;  //!< met so far
  std::size_t taken = 0;     //!< of these went into observations
  std::string reason;        //!< what the topic is taken as, or why it is not
};

/** Observations that are complete, in their order. */
using ObservationQueue = std::deque<mrpt::obs::CObservation::Ptr>;

/** Observations out of one recording, in the order of the file.
 *
 * Times of points stay as they were recorded: findPointTimes() decides their unit and reference.
 * Labels are the names of the topics. Memory is bounded: by the largest message, and for packets by
 * a scan of each sensor. */
class RecordingReader
{
 public:
  RecordingReader() = default;
  virtual ~RecordingReader() = default;
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  /** Never throws for what the file holds. Once EndOfRecording was returned it is returned again.
   */
  [[nodiscard]] virtual NextRecorded next() = 0;

  /** Bytes of the files, as they lie on disk, that have been used. */
  [[nodiscard]] virtual std::uint64_t position() const = 0;

  /** The topics found so far; complete behind the end. */
  [[nodiscard]] virtual std::vector<TopicReport> topics() const = 0;

  /** Sentences for people: where the poses of sensors come from, and the like. */
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/** A row of the table of formats, recordingFormats(). */
struct RecordingFormat
{
  const char* name;     //!< "rosbag1"
  const char* content;  //!< for people: "ROS 1 bag (.bag)"
  /** Whether the path leads to such a recording: the content decides, not the name. Never throws.
   */
  bool (*recognises)(const std::string& path);
  /** \exception std::runtime_error it cannot be opened */
  std::unique_ptr<RecordingReader> (*open)(const std::string& path);
};

/** The size of a file, or of the files below a folder [bytes]; zero where there is none. */
[[nodiscard]] std::uint64_t recordingBytes(const std::string& path);

}  // namespace fastlio
