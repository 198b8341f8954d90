// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file inflating_file.h A file, plain or gzip, as one run of uncompressed bytes. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace fastlio
{
/** How a file ended. MRPT's CFileGZInputStream does not tell these apart. */
enum class FileEnd
{
  NotYet,
  Clean,
  Truncated,  //!< inside the compressed data
  Corrupt     //!< compressed data that do not decompress, or a wrong checksum
};

class InflatingFile
{
 public:
  /** \exception std::runtime_error the file cannot be opened */
  explicit InflatingFile(const std::string& path);

  /** Up to \a size bytes; fewer only at the end, which end() then explains. */
  std::size_t read(char* data, std::size_t size);

  [[nodiscard]] FileEnd end() const { return end_; }

  /** Bytes of the file as it lies on disk that have been used. */
  [[nodiscard]] std::uint64_t compressedPosition() const;

 private:
  struct Closer
  {
    void operator()(void* file) const;
  };
  std::unique_ptr<void, Closer> file_;
  FileEnd end_ = FileEnd::NotYet;
};

}  // namespace fastlio
