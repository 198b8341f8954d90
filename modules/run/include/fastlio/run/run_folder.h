// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_folder.h The folder that a run writes into: it holds one run. */
#pragma once

#include <fastlio/files/atomic_file.h>
#include <fastlio/files/folder_lock.h>
#include <fastlio/files/made_folders.h>

#include <functional>
#include <string>
#include <vector>

namespace fastlio
{
/** The record of a run, and its key that distinguishes it from files of others. */
inline constexpr const char* kSummaryFile = "summary.json";
inline constexpr const char* kSummaryKey = "exit_status";

/** The files that a run is going to write into a folder. */
struct RunFolderPlan
{
  std::string directory;
  std::vector<std::string> files;  //!< names, without the folder
  std::string record;              //!< the file among them that each complete run writes (JSON)
  std::string record_key;          //!< a key that distinguishes such a file from others
  bool overwrite = false;          //!< also files of others may be replaced
  std::string program = {};        //!< as its record names it; empty: the record names none
  /** Whether another run of the program may write a file of this name; empty: all are in files. */
  std::function<bool(const std::string& name)> writes = {};
};

/** Checks, without making anything, that the folder can be written, that it holds no run of another
 * program, and that everything which the run would replace was written by an earlier run: the
 * record lies beside it, or the lock file of a run that was killed.
 * \exception std::runtime_error otherwise; the message names the file or the program */
void requireReplaceable(const RunFolderPlan& plan);

/** Whether a run has left its kSummaryFile in the folder, or its lock file. */
[[nodiscard]] bool holdsRun(const std::string& directory);

/** A folder that belongs to this process until the end. A folder that it had to make goes again
 * when it is empty in the end. */
class RunFolder
{
 public:
  /** Makes the folder when it is not there.
   * \exception std::runtime_error another run holds it, or requireReplaceable() fails */
  explicit RunFolder(RunFolderPlan plan);

  /** Once the run is complete: removes the files that the run before has written, according to its
   * record, and that this one has not; also what a killed run has left unfinished. Nothing else is
   * touched, nor what is among \a kept, the inputs. Anybody may have edited the record: only files
   * that the program writes are removed. */
  void removeLeftovers(const std::vector<std::string>& kept) const;

 private:
  RunFolderPlan plan_;
  MadeFolders made_;
  FolderLock lock_;
  std::vector<OutputFile> earlier_;  //!< what the record of the run before lists
};

}  // namespace fastlio
