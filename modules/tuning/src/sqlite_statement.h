// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sqlite_statement.h Statements and transactions of SQLite, with errors as exceptions. */
#pragma once

#include <cstdint>
#include <memory>
#include <sqlite3.h>
#include <string>

namespace fastlio
{
/** A prepared statement; its parameters are counted from 1, its columns from 0. */
class SqliteStatement
{
 public:
  SqliteStatement(sqlite3* database, const std::string& path, const std::string& sql);
  SqliteStatement& bind(int i, const std::string& text);
  SqliteStatement& bind(int i, double number);
  SqliteStatement& bind(int i, std::int64_t number);
  /** \return whether there is a row */
  bool step();
  /** All rows, unread. */
  void run();
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] double number(int column) const;
  [[nodiscard]] std::int64_t whole(int column) const;

 private:
  [[nodiscard]] sqlite3_stmt* get() const { return statement_.get(); }
  void require(int status) const;
  sqlite3* database_;
  std::string path_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};

/** Takes the lock for writing at once, so that a busy file is waited for instead of a deadlock;
 * rolled back unless committed. */
class SqliteTransaction
{
 public:
  SqliteTransaction(sqlite3* database, const std::string& path);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;
  void commit();

 private:
  sqlite3* database_;
  std::string path_;
  bool open_ = true;
};

}  // namespace fastlio
