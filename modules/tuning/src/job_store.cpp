// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/job_store.h>

#include <chrono>
#include <sqlite3.h>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr int kBusyMilliseconds = 60000;

double now()
{
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/** A prepared statement; its parameters are counted from 1. */
class Statement
{
 public:
  Statement(sqlite3* database, const std::string& path, const char* sql)
      : database_(database), path_(path), statement_(nullptr, &sqlite3_finalize)
  {
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v2(database, sql, -1, &raw, nullptr) != SQLITE_OK) fail();
    statement_.reset(raw);
  }
  Statement& bind(int i, const std::string& text)
  {
    if (sqlite3_bind_text(get(), i, text.c_str(), -1, SQLITE_TRANSIENT) != SQLITE_OK) fail();
    return *this;
  }
  Statement& bind(int i, const std::optional<double>& number)
  {
    const int status =
        number ? sqlite3_bind_double(get(), i, *number) : sqlite3_bind_null(get(), i);
    if (status != SQLITE_OK) fail();
    return *this;
  }
  /** \return whether there is a row */
  bool step()
  {
    const int status = sqlite3_step(get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) fail();
    return status == SQLITE_ROW;
  }
  [[nodiscard]] std::string text(int column) const
  {
    const unsigned char* bytes = sqlite3_column_text(get(), column);
    return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
  }
  [[nodiscard]] std::optional<double> number(int column) const
  {
    if (sqlite3_column_type(get(), column) == SQLITE_NULL) return std::nullopt;
    return sqlite3_column_double(get(), column);
  }

 private:
  [[nodiscard]] sqlite3_stmt* get() const { return statement_.get(); }
  [[noreturn]] void fail() const
  {
    throw std::runtime_error("job store '" + path_ + "': " + sqlite3_errmsg(database_));
  }
  sqlite3* database_;
  const std::string& path_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};
}  // namespace

JobStore::JobStore(const std::string& path) : path_(path), database_(nullptr, &sqlite3_close)
{
  sqlite3* raw = nullptr;
  const int status = sqlite3_open(path.c_str(), &raw);
  database_.reset(raw);
  if (status != SQLITE_OK)
    throw std::runtime_error("job store '" + path + "' cannot be opened: " + sqlite3_errmsg(raw));
  sqlite3_busy_timeout(raw, kBusyMilliseconds);
  // A rollback journal, not WAL: it also works where processes of several machines share a folder
  // whose file locks are right. A change takes milliseconds, a job seconds.
  Statement(
      raw, path_,
      "CREATE TABLE IF NOT EXISTS jobs (parameters TEXT NOT NULL, "
      "recording TEXT NOT NULL, owner TEXT NOT NULL DEFAULT '', "
      "lease_end REAL NOT NULL DEFAULT 0, finished INTEGER NOT NULL DEFAULT 0, "
      "error REAL, message TEXT, PRIMARY KEY (parameters, recording))")
      .step();
}

void JobStore::add(const Job& job)
{
  Statement(
      database_.get(), path_, "INSERT OR IGNORE INTO jobs (parameters, recording) VALUES (?, ?)")
      .bind(1, job.parameters)
      .bind(2, job.recording)
      .step();
}

std::optional<Job> JobStore::claim(const std::string& owner, double lease_seconds)
{
  // One statement, hence one transaction with the lock for writing: two cannot take the same row.
  Statement statement(
      database_.get(), path_,
      "UPDATE jobs SET owner = ?, lease_end = ? WHERE rowid = (SELECT rowid FROM jobs "
      "WHERE finished = 0 AND lease_end < ? ORDER BY rowid LIMIT 1) "
      "RETURNING parameters, recording");
  statement.bind(1, owner).bind(2, now() + lease_seconds).bind(3, now());
  if (!statement.step()) return std::nullopt;
  Job job{statement.text(0), statement.text(1)};
  while (statement.step())
  {
  }
  return job;
}

bool JobStore::finish(const std::string& owner, const Job& job, const JobResult& result)
{
  Statement(
      database_.get(), path_,
      "UPDATE jobs SET finished = 1, error = ?, message = ? "
      "WHERE parameters = ? AND recording = ? AND owner = ? AND finished = 0")
      .bind(1, result.error)
      .bind(2, result.message)
      .bind(3, job.parameters)
      .bind(4, job.recording)
      .bind(5, owner)
      .step();
  return sqlite3_changes(database_.get()) == 1;
}

std::optional<JobResult> JobStore::result(const Job& job)
{
  Statement statement(
      database_.get(), path_,
      "SELECT error, message FROM jobs WHERE parameters = ? AND recording = ? AND finished = 1");
  statement.bind(1, job.parameters).bind(2, job.recording);
  if (!statement.step()) return std::nullopt;
  return JobResult{statement.number(0), statement.text(1)};
}

}  // namespace fastlio
