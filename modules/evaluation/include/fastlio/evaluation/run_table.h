// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_table.h The CSV files of a run. */
#pragma once

#include <fastlio/math/pose.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Rows by the names of the columns, which the first line that is no comment (#) gives. Every error
 * is a std::runtime_error that names file and line. */
class RunTable
{
 public:
  /** \exception std::runtime_error it cannot be read, has no columns, or a row has other columns
   * than the first line */
  explicit RunTable(std::filesystem::path file);

  /** Number of rows. */
  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  [[nodiscard]] bool has(std::string_view name) const;
  /** The places of columns in each row. \exception std::runtime_error some are not there; names all
   * of these */
  [[nodiscard]] std::vector<std::size_t> columns(const std::vector<std::string>& names) const;

  /** Valid as long as the table. \param column its place in the row */
  [[nodiscard]] std::string_view text(std::size_t row, std::size_t column) const;
  /** \exception std::runtime_error there is no such column */
  [[nodiscard]] std::string_view text(std::size_t row, std::string_view name) const;
  /** \exception std::runtime_error there is no such column, or the text is no number */
  [[nodiscard]] double number(std::size_t row, std::string_view name) const;
  /** Integer nanoseconds. \exception std::runtime_error as number() */
  [[nodiscard]] std::int64_t stamp(std::size_t row, std::string_view name) const;
  /** \exception std::runtime_error as number() */
  [[nodiscard]] Vec3 vector(std::size_t row, const std::array<std::string_view, 3>& names) const;

  /** Where a row, and the names of the columns, stand in the file, from 1. */
  [[nodiscard]] std::size_t line(std::size_t row) const { return lines_.at(row); }
  [[nodiscard]] std::size_t headerLine() const { return header_line_; }

 private:
  void add(std::string_view text, std::size_t line);
  /** As many as there are columns: it is not there. */
  [[nodiscard]] std::size_t placeOf(std::string_view name) const;

  std::filesystem::path file_;
  std::vector<std::string> names_;
  std::size_t header_line_ = 0;
  std::string cells_;               // of all rows, one behind the other
  std::vector<std::size_t> ends_;   // of the cells
  std::vector<std::size_t> lines_;  // by row: its line in the file
};

}  // namespace fastlio
