// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inflating_file.h A file, plain, gzip or Zstandard, as one run of uncompressed bytes. */
#pragma once

#include <fastlio/recordings/byte_source.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace fastlio
{
/** How a file ended. MRPT's CFileGZInputStream does not distinguish these. */
enum class FileEnd
{
  NotYet,
  Clean,
  Truncated,  //!< inside the compressed data
  Corrupt     //!< compressed data that do not decompress, a wrong checksum, or a failing disk
};

/** Reads as gzip(1) does: members one after the other are one file, what follows them and is none
 * is left alone, and a file that does not begin as one is plain. Frames of Zstandard, which MRPT
 * 2.15.7 and newer write, are read alike. */
class InflatingFile
{
 public:
  /** \exception std::runtime_error the file cannot be opened */
  explicit InflatingFile(
      const std::string& path, std::unique_ptr<Inflater> for_gzip = fastestInflater());

  /** Of those that are built in. */
  [[nodiscard]] static std::unique_ptr<Inflater> fastestInflater();

  /** Up to \a size bytes; fewer only at the end, which end() then explains. */
  std::size_t read(char* data, std::size_t size);
  [[nodiscard]] FileEnd end() const { return end_; }
  /** Bytes of the file as it lies on disk that have been used. */
  [[nodiscard]] std::uint64_t compressedPosition() const
  {
    return file_.position() - bytes_.waiting();
  }

 private:
  FileBytes file_;
  std::string_view magic_;  // of its members; empty: the file is plain
  StretchBytes bytes_;
  FileEnd end_ = FileEnd::NotYet;
};

}  // namespace fastlio
