// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gzip_file.h A gzip file that MRPT's archives write to, piece by piece; it gets its name
 * when it is complete. MRPT's own gzip stream does not report a full disk. */
#pragma once

#include <fastlio/files/atomic_file.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace fastlio
{
class GzipDeflater;

/** Has what mrpt::serialization::archiveFrom() asks of a stream. */
class GzipFile
{
 public:
  /** \exception std::runtime_error the file cannot be opened */
  explicit GzipFile(const std::string& path);
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  /** \exception std::runtime_error the disk refused the bytes */
  std::size_t Write(const void* data, std::size_t size);
  void write(std::string_view bytes) { Write(bytes.data(), bytes.size()); }

  /** \exception std::logic_error always: this stream is for writing */
  std::size_t Read(void* data, std::size_t size);
  [[nodiscard]] std::string getStreamDescription() const { return "gzip file"; }

  /** \exception std::runtime_error the bytes did not reach the disk, or the rename failed */
  OutputFile commit();

 private:
  void pack(std::string_view bytes, bool end);

  AtomicFile file_;
  std::unique_ptr<GzipDeflater> deflater_;
};

}  // namespace fastlio
