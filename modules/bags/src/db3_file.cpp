// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "db3_file.h"

#include <fastlio/options/printable.h>

#include <algorithm>
#include <sqlite3.h>

namespace fastlio
{
namespace
{
using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

// Limit of the steps that one row may cost the database's machine: views and generated columns of a
// hostile file could take for ever.
constexpr int kStepsPerCall = 100'000;
constexpr std::uint64_t kMostCalls = 1000;

int countSteps(void* counter)
{
  return ++*static_cast<std::uint64_t*>(counter) > kMostCalls ? 1 : 0;
}

Statement prepare(sqlite3* database, const char* text)
{
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database, text, -1, &statement, nullptr);
  return {statement, sqlite3_finalize};
}

std::string textOf(sqlite3_stmt* row, int column)
{
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text == nullptr ? "" : text;
}

std::int64_t numberOf(sqlite3* database, const char* query)
{
  const Statement statement = prepare(database, query);
  if (!statement || sqlite3_step(statement.get()) != SQLITE_ROW) return 0;
  return sqlite3_column_int64(statement.get(), 0);
}
}  // namespace

const std::string& sqliteMagic()
{
  static const std::string magic("SQLite format 3\0", 16);
  return magic;
}

bool isDb3(const std::string& path)
{
  return headOf(path, sqliteMagic().size()) == sqliteMagic();
}

Db3File::Db3File(const std::string& path) : Db3File(path, path) {}

Db3File::Db3File(const std::string& path, std::string shown_name)
    : shown_name_(std::move(shown_name)),
      database_(nullptr, sqlite3_close),
      rows_(nullptr, sqlite3_finalize)
{
  bytes_ = FileBytes(path).size();
  open(path);
  const bool tables = numberOf(
                          database_.get(),
                          "SELECT COUNT(*) FROM sqlite_master WHERE type='table' AND name IN "
                          "('topics','messages')") == 2;
  if (!tables)
    throw std::runtime_error(
        "is an SQLite database without the tables 'topics' and 'messages' of a ROS 2 bag (" +
        std::string(sqlite3_errmsg(database_.get())) + ")");
  readTopics();
  last_row_ = numberOf(database_.get(), "SELECT MAX(rowid) FROM messages");
  if (!query(0))
    throw std::runtime_error(std::string("cannot be read: ") + sqlite3_errmsg(database_.get()));
}

Db3File::~Db3File() = default;

void Db3File::open(const std::string& path)
{
  sqlite3* database = nullptr;
  const int result =
      sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK || database == nullptr)
    throw std::runtime_error(
        std::string("cannot be opened: ") + (database == nullptr ? "" : sqlite3_errmsg(database)));
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, static_cast<int>(kLargestRecord));
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_progress_handler(database, kStepsPerCall, countSteps, &steps_);
  // writable_schema lets a cut file be read as far as it goes; nothing is written.
  sqlite3_exec(
      database, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0; PRAGMA writable_schema=ON", nullptr,
      nullptr, nullptr);
}

void Db3File::readTopics()
{
  constexpr std::size_t kMostTopics = 100'000;
  const Statement rows =
      prepare(database_.get(), "SELECT id, name, type, serialization_format FROM topics");
  if (!rows)
    throw std::runtime_error(std::string("cannot be read: ") + sqlite3_errmsg(database_.get()));
  while (topics_.size() < kMostTopics && sqlite3_step(rows.get()) == SQLITE_ROW)
  {
    RosTopic topic{textOf(rows.get(), 1), textOf(rows.get(), 2), WireFormat::Cdr, ""};
    const std::string format = textOf(rows.get(), 3);
    if (format != "cdr") topic.trouble = "the encoding '" + format + "' is not known (cdr is)";
    topics_[sqlite3_column_int64(rows.get(), 0)] = std::move(topic);
  }
}

bool Db3File::query(std::int64_t behind)
{
  rows_ = prepare(
      database_.get(), "SELECT rowid, topic_id, data FROM messages WHERE rowid > ? ORDER BY rowid");
  return rows_ && sqlite3_bind_int64(rows_.get(), 1, behind) == SQLITE_OK;
}

NextMessage Db3File::next(const TopicFilter& wanted)
{
  if (finished_) return EndOfRecording{};
  steps_ = 0;
  const int result = sqlite3_step(rows_.get());
  // Rows that do not go forward come out of pages that lead in circles.
  const bool forward = result == SQLITE_ROW && sqlite3_column_int64(rows_.get(), 0) > row_;
  if (forward) return messageOfRow(wanted);
  if (result == SQLITE_ROW) return damage("its rows do not go forward");
  if (result != SQLITE_DONE) return damage(sqlite3_errmsg(database_.get()));
  finished_ = true;
  return EndOfRecording{};
}

NextMessage Db3File::messageOfRow(const TopicFilter& wanted)
{
  row_ = sqlite3_column_int64(rows_.get(), 0);
  const std::int64_t number = sqlite3_column_int64(rows_.get(), 1);
  const auto known = topics_.find(number);
  RosTopic& topic = known != topics_.end() ? known->second : topics_[0];
  if (topic.name.empty())
    topic = {"unknown topic", "", WireFormat::Cdr, "no row of the topics has its name and type"};
  message_ = {&topic, nullptr, position()};
  if (!wanted(topic)) return message_;
  const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(rows_.get(), 2));
  const int size = sqlite3_column_bytes(rows_.get(), 2);
  data_.assign(data, data + (data == nullptr ? 0 : size));
  message_.data = &data_;
  return message_;
}

// Goes on with the next rows that can be read, in steps that grow.
NextMessage Db3File::damage(const std::string& why)
{
  constexpr std::size_t kMostDamages = 1000;
  constexpr std::int64_t kLatestRow = std::int64_t{1} << 40U;
  const std::int64_t from = row_;
  // The page that holds the last row may be the damaged one.
  const std::int64_t last = last_row_ > 0 ? std::min(last_row_, kLatestRow) : kLatestRow;
  bool found = false;
  ++damages_;
  for (std::int64_t step = 1; !found && damages_ < kMostDamages && row_ < last; step *= 2)
  {
    row_ = std::min(row_ + step, last);
    steps_ = 0;
    found = query(row_) && sqlite3_step(rows_.get()) == SQLITE_ROW && query(row_);
  }
  finished_ = !found;
  const bool cut = isCut();
  return ReadProblem{
      shown_name_, cut ? ReadProblemKind::Truncated : ReadProblemKind::Corrupt, "",
      shown_name_ + ": behind row " + std::to_string(from) + " of " + std::to_string(last_row_) +
          " the database cannot be read (" + printable(why) + "). " +
          (found ? "Reading goes on behind row " + std::to_string(row_) + ". " : "") +
          (cut ? "The recording or a copy of it was cut off."
               : "Copy the file anew, or check the medium it lies on.")};
}

bool Db3File::isCut() const
{
  const auto pages = numberOf(database_.get(), "PRAGMA page_count");
  const auto size = numberOf(database_.get(), "PRAGMA page_size");
  return pages > 0 && size > 0 &&
         static_cast<std::uint64_t>(pages) > bytes_ / static_cast<std::uint64_t>(size);
}

std::uint64_t Db3File::position() const
{
  if (last_row_ <= 0 || finished_) return bytes_;
  const double share = static_cast<double>(row_) / static_cast<double>(last_row_);
  return static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(bytes_));
}

std::vector<const RosTopic*> Db3File::topics() const
{
  std::vector<const RosTopic*> topics;
  for (const auto& [id, topic] : topics_)
    topics.push_back(&topic);
  return topics;
}

}  // namespace fastlio
