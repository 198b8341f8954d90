// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rawlog_parts.h Observations as one rawlog, or as several. */
#pragma once

#include <fastlio/files/atomic_file.h>

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
enum class RawlogCompression
{
  None,
  Gzip,
  Zstd
};

/** Where the bytes of a rawlog go. */
class RawlogFile
{
 public:
  RawlogFile() = default;
  virtual ~RawlogFile() = default;
  RawlogFile(const RawlogFile&) = delete;
  RawlogFile& operator=(const RawlogFile&) = delete;

  /** \exception std::runtime_error the disk refused the bytes */
  virtual void write(std::string_view bytes) = 0;
  virtual OutputFile commit() = 0;
};

/** Where observations go. */
class ImportOutput
{
 public:
  ImportOutput() = default;
  virtual ~ImportOutput() = default;
  ImportOutput(const ImportOutput&) = delete;
  ImportOutput& operator=(const ImportOutput&) = delete;

  /** \return whether it was written: not every format takes every class
   * \exception std::runtime_error the disk refused it */
  virtual bool write(const mrpt::obs::CObservation& observation) = 0;

  /** The files. Nothing was written: there are none. */
  [[nodiscard]] virtual std::vector<OutputFile> finish() = 0;
};

/** Each file gets its name when it is complete. */
class RawlogParts : public ImportOutput
{
 public:
  struct Options
  {
    std::string path;
    RawlogCompression compression = RawlogCompression::Gzip;
    double split_mib = 0;      //!< before compression; zero: no limit
    double split_seconds = 0;  //!< zero: no limit
  };

  explicit RawlogParts(Options options) : options_(std::move(options)) {}

  bool write(const mrpt::obs::CObservation& observation) override;
  [[nodiscard]] std::vector<OutputFile> finish() override;

  /** The path of a part, counted from 0. */
  [[nodiscard]] static std::string pathOfPart(const Options& options, std::size_t part);
  /** Which part has a file of that name; nothing: none. */
  [[nodiscard]] static std::optional<std::size_t> partOf(
      const Options& options, const std::string& file_name);

 private:
  [[nodiscard]] bool isFull(std::int64_t stamp_ns) const;
  void close();

  Options options_;
  std::unique_ptr<RawlogFile> file_;
  std::vector<OutputFile> files_;
  std::uint64_t bytes_ = 0;    // in the file at hand, before compression
  std::int64_t first_ns_ = 0;  // of it
};

}  // namespace fastlio
