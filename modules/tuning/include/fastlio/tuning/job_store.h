// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file job_store.h Jobs and their outcomes in an SQLite file that several processes share. */
#pragma once

#include <fastlio/tuning/process_identity.h>
#include <fastlio/tuning/run_outcome.h>

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
  std::string search;      //!< to which it belongs; names everything that its outcome depends on
  std::string parameters;  //!< YAML
  std::string recording;   //!< path
  std::string truth;       //!< path; empty: there is none
  std::string frame;       //!< whose pose the truth is: vehicle or imu
};

/** Which jobs somebody takes. */
struct ClaimFilter
{
  std::string version;  //!< of the program: only jobs that this version has added
  std::string search;   //!< empty: of any search
};

/** One of the workers of a process. */
struct Worker
{
  ProcessIdentity process;
  int number = 0;
};

/** How many jobs a search has. */
struct SearchCounts
{
  std::string search, version;
  std::size_t open = 0, running = 0, finished = 0, failed = 0;  //!< failed: of the finished ones
  std::size_t started = 0;  //!< claims, so that started - finished are those that were cut off
};

/** The faults that a change survives when the call that makes it has returned. */
enum class Durability
{
  Power,   //!< a power failure
  Process  //!< the end of the process, however it ends; faster
};

/** A job is claimed by one worker at a time. A claim ends with finish() or release(), when its
 * process is gone (found out at once by workers on the same host), or after its lease. So a killed
 * process loses its running jobs only. Every change is one transaction. One thread at a time uses
 * an object; each thread may open its own. All functions throw std::runtime_error, which names the
 * file, when it cannot be read or written. */
class JobStore
{
 public:
  explicit JobStore(const std::string& path, Durability durability = Durability::Power);
  /** Adds those that are not there, in one transaction. */
  void add(const std::string& version, const std::vector<Job>& jobs);
  /** Takes a job that nobody runs, for \a lease_seconds; nothing when there is none. */
  [[nodiscard]] std::optional<Job> claim(
      const Worker& worker, const ClaimFilter& filter, double lease_seconds);
  /** \return false when another worker has the job */
  bool renew(const Worker& worker, const Job& job, double lease_seconds);
  /** Stores the outcome of a claimed job.
   * \return false when another worker has the job: nothing is stored then */
  bool finish(const Worker& worker, const Job& job, const RunOutcome& outcome);
  /** Gives a claimed job back. */
  void release(const Worker& worker, const Job& job);
  /** Opens the failed jobs of a search again (empty: of all). \return how many */
  std::size_t retryFailed(const std::string& search);
  /** The outcome, or nothing while the job is not finished. */
  [[nodiscard]] std::optional<RunOutcome> outcome(const Job& job);
  /** Jobs of the filter that are not finished, running ones included. */
  [[nodiscard]] std::size_t unfinished(const ClaimFilter& filter);
  [[nodiscard]] std::vector<SearchCounts> counts();

 private:
  [[nodiscard]] std::optional<Job> claimOpen(
      const Worker& worker, const ClaimFilter& filter, double lease_seconds);
  bool freeDead(const std::string& host);

  std::string path_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

}  // namespace fastlio
