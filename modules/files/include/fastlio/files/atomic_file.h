// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file atomic_file.h Output files that appear under their name only when they are complete. */
#pragma once

#include <fastlio/files/file_descriptor.h>

#include <cstdint>
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

/** Writes to a temporary file beside `<path>` and gives it that name on commit().
 *
 * Readers never see half a file, and an older file of that name stays until its successor is on the
 * disk, also when the power fails. Destroyed without commit(), the temporary file is removed; when
 * the process is killed it stays, as `<path>.XXXXXXXX.tmp`. A symbolic link is followed: the file
 * that it points to is replaced. What is no regular file (a device, a pipe), and what is the
 * standard output or error of the process, is written to directly.
 */
class AtomicFile
{
 public:
  /** Opens the temporary file; a pipe is waited for until somebody reads it.
   * \exception std::runtime_error it cannot be opened, or `<path>` may not be written */
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /** Appends bytes.
   * \exception std::runtime_error the disk refused them */
  void write(std::string_view bytes);

  /** Replaces bytes that write() has taken, as a header does that counts what follows it.
   * \exception std::logic_error they would go beyond what was written
   * \exception std::runtime_error the disk refused them, or isRewritable() is false */
  void overwrite(std::uintmax_t offset, std::string_view bytes);

  /** False for a pipe, a device and the standard output of the process. */
  [[nodiscard]] bool isRewritable() const { return !temporary_.empty(); }

  /** Brings the bytes to the disk, then renames.
   * \exception std::runtime_error the bytes did not reach the disk or the rename failed; an older
   * file is still there */
  OutputFile commit();

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  void openDirectly();
  void openTemporary(const std::string& target);
  void flush();
  void writeThrough(std::string_view bytes);
  void rename();

  std::string path_;
  std::string target_;     //!< what is replaced: the path with links followed
  std::string temporary_;  //!< empty: written directly, or renamed
  std::string buffer_;
  std::uintmax_t bytes_ = 0;
  FileDescriptor file_;
};

/** A whole file in one go.
 * \exception std::runtime_error the file cannot be written */
OutputFile writeFileAtomically(const std::string& path, std::string_view content);

/** Whether \a name is that of a temporary file of AtomicFile for a file called \a file. */
[[nodiscard]] bool isTemporaryOf(std::string_view file, std::string_view name);

}  // namespace fastlio
