// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file atomic_file.h Output files that appear under their name only when they are complete. */
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace fastlio
{
/** A file that a run has written. */
struct OutputFile
{
  std::string path;
  std::uintmax_t bytes = 0;
};

/** Where the content of \a path grows until it is complete: `<path>.tmp`. */
[[nodiscard]] std::string temporaryPathOf(const std::string& path);

/** Renames `<path>.tmp` to \a path, replacing an older file of that name.
 * \exception std::runtime_error the rename failed; the temporary file stays */
OutputFile renameIntoPlace(const std::string& path);

/** Creates \a directory (and its parents) when absent and proves that files can be written there.
 * \exception std::runtime_error it cannot be created or written */
void prepareOutputDirectory(const std::string& directory);

/** Writes to `<path>.tmp` and renames to `<path>` on commit().
 *
 * Readers never see half a file, and a file of an earlier run stays until its successor is
 * complete. Destroyed without commit(), the temporary file stays: what was computed is not lost.
 */
class AtomicFile
{
 public:
  /** Opens the temporary file.
   * \exception std::runtime_error it cannot be opened */
  explicit AtomicFile(std::string path);

  /** Appends bytes.
   * \exception std::runtime_error the disk refused them */
  void write(std::string_view bytes);

  /** Flushes, closes and renames.
   * \exception std::runtime_error the bytes did not reach the disk or
   * the rename failed */
  OutputFile commit();

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::ofstream out_;
};

/** A whole file in one go.
 * \exception std::runtime_error the file cannot be written */
OutputFile writeFileAtomically(const std::string& path, std::string_view content);

}  // namespace fastlio
