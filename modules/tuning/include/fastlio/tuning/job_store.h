// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file job_store.h Jobs and their results in an SQLite file that several processes share. */
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

struct sqlite3;

namespace fastlio
{
/** One run: a configuration on a recording. */
struct Job
{
  std::string parameters;  //!< YAML
  std::string recording;   //!< names the file and its content (see the caller)
};

/** What became of it. */
struct JobResult
{
  std::optional<double> error;  //!< nothing: the run failed
  std::string message;          //!< why it failed
};

/** A job is claimed by one process at a time. A claim ends with finish(), or after its lease, so
 * that a killed process loses its running jobs only. Every change is one transaction. One thread at
 * a time uses an object; each thread may open its own. All functions throw std::runtime_error,
 * which names the file, when it cannot be read or written. */
class JobStore
{
 public:
  explicit JobStore(const std::string& path);
  /** Adds a job unless it is there. */
  void add(const Job& job);
  /** Takes a job that nobody runs, for \a lease_seconds; nothing when there is none. */
  [[nodiscard]] std::optional<Job> claim(const std::string& owner, double lease_seconds);
  /** Stores the result of a claimed job.
   * \return false when the lease was over and another owner took the job: nothing is stored then */
  bool finish(const std::string& owner, const Job& job, const JobResult& result);
  /** The result, or nothing while the job is not finished. */
  [[nodiscard]] std::optional<JobResult> result(const Job& job);

 private:
  std::string path_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

}  // namespace fastlio
