// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_table.h The CSV files of a run. */
#pragma once

#include <fastlio/math/so3.h>

#include <array>
#include <cstddef>
#include <cstdint>
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
  /** A larger file is refused: a run of a week has less. */
  static constexpr std::size_t kMostBytes = std::size_t{2} << 30U;

  /** \exception std::runtime_error it cannot be read, has no columns, a row has other columns than
   * the first line, or there are more bytes than kMostBytes */
  explicit RunTable(const std::string& path);

  /** Number of rows. */
  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  [[nodiscard]] bool has(std::string_view name) const;

  /** Valid as long as the table. \exception std::runtime_error there is no such column */
  [[nodiscard]] std::string_view text(std::size_t row, std::string_view name) const;
  /** \exception std::runtime_error there is no such column, or the text is no number */
  [[nodiscard]] double number(std::size_t row, std::string_view name) const;
  /** Integer nanoseconds. \exception std::runtime_error as number() */
  [[nodiscard]] std::int64_t stamp(std::size_t row, std::string_view name) const;
  /** \exception std::runtime_error as number() */
  [[nodiscard]] Vec3 vector(std::size_t row, const std::array<std::string_view, 3>& names) const;

 private:
  void add(std::string_view line, std::size_t number);
  [[nodiscard]] std::size_t column(std::string_view name) const;
  [[noreturn]] void fail(std::size_t line, const std::string& what) const;

  std::string path_;
  std::vector<std::string> names_;
  std::string cells_;               // of all rows, one behind the other
  std::vector<std::size_t> ends_;   // of the cells
  std::vector<std::size_t> lines_;  // by row: its line in the file
};

}  // namespace fastlio
