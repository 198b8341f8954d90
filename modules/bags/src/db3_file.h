// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file db3_file.h Bags of ROS 2 in an SQLite database. */
#pragma once

#include "ros_recording.h"

struct sqlite3;
struct sqlite3_stmt;

namespace fastlio
{
/** Reads the rows in the order in which they were written. Behind damaged pages it goes on with
 * later rows. */
class Db3File : public RosMessageSource
{
 public:
  /** \exception std::runtime_error it cannot be opened, or has no tables of a bag */
  explicit Db3File(const std::string& path);
  /** \param shown_name the name of the file in messages */
  Db3File(const std::string& path, std::string shown_name);
  ~Db3File() override;

  [[nodiscard]] NextMessage next(const TopicFilter& wanted) override;
  [[nodiscard]] std::uint64_t position() const override;
  [[nodiscard]] std::vector<const RosTopic*> topics() const override;
  [[nodiscard]] bool listsAllTopics() const override { return true; }

 private:
  void open(const std::string& path);
  void readTopics();
  [[nodiscard]] bool query(std::int64_t behind);
  [[nodiscard]] NextMessage messageOfRow(const TopicFilter& wanted);
  [[nodiscard]] NextMessage damage(const std::string& why);
  [[nodiscard]] bool isCut() const;

  std::string shown_name_;
  std::uint64_t bytes_ = 0;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> rows_;
  std::map<std::int64_t, RosTopic> topics_;
  std::int64_t row_ = 0, last_row_ = 0;  // rowid of the one at hand, and of the last one
  std::uint64_t steps_ = 0;              // of the database's machine for the row at hand
  Bytes data_;
  RosMessage message_;
  std::size_t damages_ = 0;  // behind which reading went on
  bool finished_ = false;
};

[[nodiscard]] bool isDb3(const std::string& path);

/** The first bytes of every such file. */
[[nodiscard]] const std::string& sqliteMagic();

}  // namespace fastlio
