// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sqlite_statement.h"
#include <fastlio/tuning/job_store.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
using Statement = SqliteStatement;
constexpr int kBusyMilliseconds = 60000;
constexpr std::int64_t kApplication = 0x464C5455;  // marks the file as a store
constexpr std::int64_t kSchema = 1;

constexpr const char* kTable =
    "CREATE TABLE IF NOT EXISTS jobs (search TEXT NOT NULL, parameters TEXT NOT NULL, "
    "recording TEXT NOT NULL, truth TEXT NOT NULL, frame TEXT NOT NULL, version TEXT NOT NULL, "
    "state TEXT NOT NULL DEFAULT 'open', worker TEXT NOT NULL DEFAULT '', "
    "host TEXT NOT NULL DEFAULT '', pid INTEGER NOT NULL DEFAULT 0, "
    "process_start INTEGER NOT NULL DEFAULT 0, lease_end REAL NOT NULL DEFAULT 0, "
    "started INTEGER NOT NULL DEFAULT 0, run_state TEXT NOT NULL DEFAULT '', "
    "measures TEXT NOT NULL DEFAULT '{}', message TEXT NOT NULL DEFAULT '', "
    "seconds REAL NOT NULL DEFAULT 0, PRIMARY KEY (search, parameters, recording))";
constexpr const char* kThisJob = "WHERE search = ?1 AND parameters = ?2 AND recording = ?3 ";
constexpr const char* kFiltered = "version = ?1 AND (?2 = '' OR search = ?2) ";

double now()
{
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string textOf(const Worker& worker)
{
  return worker.process.host + " " + std::to_string(worker.process.pid) + " " +
         std::to_string(worker.process.start) + " " + std::to_string(worker.number);
}

/** Binds the parameters 1 to 3 of kThisJob. */
Statement& bindJob(Statement& statement, const Job& job)
{
  return statement.bind(1, job.search).bind(2, job.parameters).bind(3, job.recording);
}

Measures measuresOf(const std::string& json)
{
  Measures measures;
  const auto object = nlohmann::json::parse(json);
  for (const auto& [name, value] : object.items())
    measures[name] = value.get<double>();
  return measures;
}

std::int64_t pragma(sqlite3* database, const std::string& path, const std::string& name)
{
  Statement statement(database, path, "PRAGMA " + name);
  return statement.step() ? statement.whole(0) : 0;
}

/** A new file becomes a store; one of another program, or of another version, is refused. */
void prepare(sqlite3* database, const std::string& path)
{
  SqliteTransaction transaction(database, path);
  const bool is_new = !Statement(database, path, "SELECT 1 FROM sqlite_master").step();
  const std::int64_t application = pragma(database, path, "application_id");
  const std::int64_t schema = pragma(database, path, "user_version");
  if (!is_new && (application != kApplication || schema != kSchema))
    throw std::runtime_error(
        "job store '" + path +
        "' is a database of another program, or of another version of this one; name another file");
  if (is_new)
  {
    Statement(database, path, kTable).run();
    Statement(database, path, "PRAGMA application_id = " + std::to_string(kApplication)).run();
    Statement(database, path, "PRAGMA user_version = " + std::to_string(kSchema)).run();
  }
  transaction.commit();
}
}  // namespace

JobStore::JobStore(const std::string& path, Durability durability)
    : path_(path), database_(nullptr, &sqlite3_close)
{
  sqlite3* raw = nullptr;
  const int status = sqlite3_open(path.c_str(), &raw);
  database_.reset(raw);
  if (status != SQLITE_OK)
    throw std::runtime_error("job store '" + path + "' cannot be opened: " + sqlite3_errmsg(raw));
  sqlite3_busy_timeout(raw, kBusyMilliseconds);
  // The journal is SQLite's rollback journal, not WAL, whose shared memory does not work where
  // processes of several machines share a folder.
  if (durability == Durability::Process) Statement(raw, path_, "PRAGMA synchronous = OFF").run();
  prepare(raw, path_);
}

void JobStore::add(const std::string& version, const std::vector<Job>& jobs)
{
  SqliteTransaction transaction(database_.get(), path_);
  for (const Job& job : jobs)
  {
    Statement statement(
        database_.get(), path_,
        "INSERT OR IGNORE INTO jobs (search, parameters, recording, truth, frame, version) "
        "VALUES (?, ?, ?, ?, ?, ?)");
    bindJob(statement, job).bind(4, job.truth).bind(5, job.frame).bind(6, version).run();
  }
  transaction.commit();
}

std::optional<Job> JobStore::claim(
    const Worker& worker, const ClaimFilter& filter, double lease_seconds)
{
  SqliteTransaction transaction(database_.get(), path_);
  auto job = claimOpen(worker, filter, lease_seconds);
  if (!job && freeDead(worker.process.host)) job = claimOpen(worker, filter, lease_seconds);
  transaction.commit();
  return job;
}

std::optional<Job> JobStore::claimOpen(
    const Worker& worker, const ClaimFilter& filter, double lease_seconds)
{
  Statement statement(
      database_.get(), path_,
      std::string("UPDATE jobs SET state = 'running', worker = ?3, host = ?4, pid = ?5, "
                  "process_start = ?6, lease_end = ?7, started = started + 1 "
                  "WHERE rowid = (SELECT rowid FROM jobs WHERE ") +
          kFiltered +
          "AND (state = 'open' OR (state = 'running' AND lease_end < ?8)) ORDER BY rowid LIMIT 1) "
          "RETURNING search, parameters, recording, truth, frame");
  statement.bind(1, filter.version)
      .bind(2, filter.search)
      .bind(3, textOf(worker))
      .bind(4, worker.process.host)
      .bind(5, worker.process.pid)
      .bind(6, worker.process.start)
      .bind(7, now() + lease_seconds)
      .bind(8, now());
  if (!statement.step()) return std::nullopt;
  Job job{
      statement.text(0), statement.text(1), statement.text(2), statement.text(3),
      statement.text(4)};
  statement.run();
  return job;
}

bool JobStore::freeDead(const std::string& host)
{
  std::vector<ProcessIdentity> processes;
  Statement select(
      database_.get(), path_,
      "SELECT DISTINCT pid, process_start FROM jobs WHERE state = 'running' AND host = ?");
  select.bind(1, host);
  while (select.step())
    processes.push_back({host, select.whole(0), select.whole(1)});
  bool freed = false;
  for (const ProcessIdentity& process : processes)
  {
    if (isRunning(process)) continue;
    Statement(
        database_.get(), path_,
        "UPDATE jobs SET state = 'open' WHERE state = 'running' AND host = ? AND pid = ? AND "
        "process_start = ?")
        .bind(1, process.host)
        .bind(2, process.pid)
        .bind(3, process.start)
        .run();
    freed = true;
  }
  return freed;
}

bool JobStore::renew(const Worker& worker, const Job& job, double lease_seconds)
{
  Statement statement(
      database_.get(), path_,
      std::string("UPDATE jobs SET lease_end = ?5 ") + kThisJob +
          "AND state = 'running' AND worker = ?4");
  bindJob(statement, job).bind(4, textOf(worker)).bind(5, now() + lease_seconds).run();
  return sqlite3_changes(database_.get()) == 1;
}

bool JobStore::finish(const Worker& worker, const Job& job, const RunOutcome& outcome)
{
  SqliteTransaction transaction(database_.get(), path_);
  Statement statement(
      database_.get(), path_,
      std::string("UPDATE jobs SET state = 'finished', run_state = ?5, measures = ?6, "
                  "message = ?7, seconds = ?8 ") +
          kThisJob + "AND state = 'running' AND worker = ?4");
  nlohmann::json measures = nlohmann::json::object();
  for (const auto& [name, value] : outcome.measures)
    if (outcome.measure(name)) measures[name] = value;
  bindJob(statement, job)
      .bind(4, textOf(worker))
      .bind(5, std::string(toText(outcome.state)))
      .bind(6, measures.dump())
      .bind(7, outcome.message)
      .bind(8, outcome.seconds)
      .run();
  const bool stored = sqlite3_changes(database_.get()) == 1;
  transaction.commit();
  return stored;
}

void JobStore::release(const Worker& worker, const Job& job)
{
  Statement statement(
      database_.get(), path_,
      std::string("UPDATE jobs SET state = 'open' ") + kThisJob +
          "AND state = 'running' AND worker = ?4");
  bindJob(statement, job).bind(4, textOf(worker)).run();
}

std::size_t JobStore::retryFailed(const std::string& search)
{
  Statement(
      database_.get(), path_,
      "UPDATE jobs SET state = 'open' WHERE state = 'finished' AND run_state = 'failed' "
      "AND (?1 = '' OR search = ?1)")
      .bind(1, search)
      .run();
  return static_cast<std::size_t>(sqlite3_changes(database_.get()));
}

std::optional<RunOutcome> JobStore::outcome(const Job& job)
{
  Statement statement(
      database_.get(), path_,
      std::string("SELECT run_state, measures, message, seconds FROM jobs ") + kThisJob +
          "AND state = 'finished'");
  if (!bindJob(statement, job).step()) return std::nullopt;
  return RunOutcome{
      runStateOf(statement.text(0)), measuresOf(statement.text(1)), statement.text(2),
      statement.number(3)};
}

std::size_t JobStore::unfinished(const ClaimFilter& filter)
{
  Statement statement(
      database_.get(), path_,
      std::string("SELECT count(*) FROM jobs WHERE state != 'finished' AND ") + kFiltered);
  statement.bind(1, filter.version).bind(2, filter.search).step();
  return static_cast<std::size_t>(statement.whole(0));
}

std::vector<SearchCounts> JobStore::counts()
{
  Statement statement(
      database_.get(), path_,
      "SELECT search, version, sum(state = 'open'), sum(state = 'running'), "
      "sum(state = 'finished'), sum(state = 'finished' AND run_state = 'failed'), sum(started) "
      "FROM jobs GROUP BY search, version ORDER BY min(rowid)");
  std::vector<SearchCounts> counts;
  const auto number = [&](int column) { return static_cast<std::size_t>(statement.whole(column)); };
  while (statement.step())
    counts.push_back(
        {statement.text(0), statement.text(1), number(2), number(3), number(4), number(5),
         number(6)});
  return counts;
}

}  // namespace fastlio
