// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_table.h The CSV files of a run. */
#pragma once

#include <fastlio/math/so3.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** Rows by the names of the columns; lines of comments are left out. */
class RunTable
{
 public:
  /** \exception std::runtime_error it cannot be read, or a row has other columns than the first */
  explicit RunTable(const std::string& path);
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /** \exception std::runtime_error there is no such column, or the text is no number */
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view name) const;
  [[nodiscard]] double number(std::size_t row, std::string_view name) const;
  [[nodiscard]] Vec3 vector(std::size_t row, const std::array<std::string_view, 3>& names) const;

 private:
  std::string path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace fastlio
