// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file timed_stream.h The sensors of a folder, each with its own files and stamps. */
#pragma once

#include <fastlio/math/pose.h>
#include <fastlio/recordings/recording_reader.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Observations of one sensor in the order of their stamps. */
class TimedStream
{
 public:
  TimedStream() = default;
  virtual ~TimedStream() = default;
  TimedStream(const TimedStream&) = delete;
  TimedStream& operator=(const TimedStream&) = delete;

  /** Of the observation at hand [ns]; nothing behind the last one. */
  [[nodiscard]] virtual std::optional<std::int64_t> stamp() const = 0;
  /** The observation at hand, or why it cannot be read; goes on to the next one. */
  [[nodiscard]] virtual NextRecorded take() = 0;
  [[nodiscard]] virtual TopicReport report() const = 0;
  /** Bytes that have been read. */
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
};

/** A file and its stamp. */
struct TimedFile
{
  std::int64_t stamp_ns = 0;
  std::string path;
};

/** One observation a file. */
class FileStream : public TimedStream
{
 public:
  /** Throws what fileProblem() may say of the file. */
  using Read = std::function<mrpt::obs::CObservation::Ptr(const TimedFile& file)>;

  /** \param report name, type and reason of it; FileStream counts */
  FileStream(TopicReport report, std::vector<TimedFile> files, Read read)
      : report_(std::move(report)), files_(std::move(files)), read_(std::move(read))
  {
  }

  [[nodiscard]] std::optional<std::int64_t> stamp() const override;
  [[nodiscard]] NextRecorded take() override;
  [[nodiscard]] TopicReport report() const override { return report_; }
  [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }

 private:
  TopicReport report_;
  std::vector<TimedFile> files_;
  Read read_;
  std::uint64_t bytes_ = 0;
};

/** Clouds in PCD files or in KITTI's .bin files. \param pose of the sensor in the vehicle, if the
 * folder holds it */
[[nodiscard]] std::unique_ptr<TimedStream> cloudStream(
    const std::string& label, std::vector<TimedFile> files, const std::string& reason,
    const std::optional<Pose>& pose = {});

/** KITTI's OXTS: acceleration and rate. */
[[nodiscard]] std::unique_ptr<TimedStream> oxtsStream(std::vector<TimedFile> files);

/** A table of inertial samples: time, angular rate, specific force, one sample a line. A first line
 * with names orders the columns, and may give units ("gyro_x [deg/s]"); without one they are time,
 * three rates, three accelerations. */
class ImuTable : public TimedStream
{
 public:
  /** \exception std::runtime_error it cannot be opened, or its first line names no such columns */
  explicit ImuTable(const std::string& path);

  [[nodiscard]] std::optional<std::int64_t> stamp() const override;
  [[nodiscard]] NextRecorded take() override;
  [[nodiscard]] TopicReport report() const override;
  [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }

 private:
  /** \return the unit of the times that the names give [ns]; 0: none */
  [[nodiscard]] std::int64_t readNames(const std::string& line);
  [[nodiscard]] std::vector<std::string> firstTimes();
  void findUnit(std::int64_t named_ns);
  void advance();
  [[nodiscard]] bool parseLine(std::string_view line);

  std::string path_;
  std::ifstream in_;
  std::vector<std::size_t> columns_;        // of time, three rates, three accelerations
  std::vector<double> factors_;             // of columns_, to units of SI
  std::optional<std::size_t> nanoseconds_;  // column of the rest of each second
  std::int64_t unit_ns_ = 1;                // of times; any, as long as it is not known
  std::optional<std::int64_t> stamp_ns_;
  std::vector<double> values_;       // three rates, three accelerations
  std::size_t taken_ = 0, bad_ = 0;  // lines
  bool told_ = false;                // that some lines are bad
  std::uint64_t bytes_ = 0;
};

/** A file that cannot be read, or a part of it. */
[[nodiscard]] ReadProblem fileProblem(const std::string& path, const std::string& what);

/** Files of a folder with one of the extensions (".bin"), by name. */
[[nodiscard]] std::vector<std::string> filesIn(
    const std::string& folder, const std::vector<std::string>& extensions);

}  // namespace fastlio
