// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sqlite_statement.h"

#include <stdexcept>

namespace fastlio
{
SqliteStatement::SqliteStatement(sqlite3* database, const std::string& path, const std::string& sql)
    : database_(database), path_(path), statement_(nullptr, &sqlite3_finalize)
{
  sqlite3_stmt* raw = nullptr;
  require(sqlite3_prepare_v2(database, sql.c_str(), -1, &raw, nullptr));
  statement_.reset(raw);
}

SqliteStatement& SqliteStatement::bind(int i, const std::string& text)
{
  require(
      sqlite3_bind_text(get(), i, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  return *this;
}

SqliteStatement& SqliteStatement::bind(int i, double number)
{
  require(sqlite3_bind_double(get(), i, number));
  return *this;
}

SqliteStatement& SqliteStatement::bind(int i, std::int64_t number)
{
  require(sqlite3_bind_int64(get(), i, number));
  return *this;
}

bool SqliteStatement::step()
{
  const int status = sqlite3_step(get());
  if (status != SQLITE_ROW && status != SQLITE_DONE) require(status);
  return status == SQLITE_ROW;
}

void SqliteStatement::run()
{
  while (step())
  {
  }
}

std::string SqliteStatement::text(int column) const
{
  const unsigned char* bytes = sqlite3_column_text(get(), column);
  return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
}

double SqliteStatement::number(int column) const
{
  return sqlite3_column_double(get(), column);
}

std::int64_t SqliteStatement::whole(int column) const
{
  return sqlite3_column_int64(get(), column);
}

void SqliteStatement::require(int status) const
{
  if (status != SQLITE_OK)
    throw std::runtime_error("job store '" + path_ + "': " + sqlite3_errmsg(database_));
}

SqliteTransaction::SqliteTransaction(sqlite3* database, const std::string& path)
    : database_(database), path_(path)
{
  SqliteStatement(database_, path_, "BEGIN IMMEDIATE").run();
}

SqliteTransaction::~SqliteTransaction()
{
  if (open_) sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void SqliteTransaction::commit()
{
  SqliteStatement(database_, path_, "COMMIT").run();
  open_ = false;
}

}  // namespace fastlio
