// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_table.h"

#include <fastlio/files/bounded_line.h>
#include <fastlio/options/number_text.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
std::vector<std::string> cellsOf(const std::string& line)
{
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}
}  // namespace

RunTable::RunTable(const std::string& path) : path_(path)
{
  std::ifstream in(path, std::ios::binary);
  for (std::string line; readBoundedLine(in, line);)
  {
    if (line.empty() || line[0] == '#') continue;
    if (names_.empty())
      names_ = cellsOf(line);
    else
      rows_.push_back(cellsOf(line));
    if (!rows_.empty() && rows_.back().size() != names_.size())
      throw std::runtime_error(
          "'" + path + "', row " + std::to_string(rows_.size()) + ": " +
          std::to_string(rows_.back().size()) + " columns instead of " +
          std::to_string(names_.size()));
  }
  if (names_.empty()) throw std::runtime_error("'" + path + "' cannot be read, or is no table");
}

const std::string& RunTable::text(std::size_t row, std::string_view name) const
{
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end())
    throw std::runtime_error("'" + path_ + "' has no column '" + std::string(name) + "'");
  return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
}

double RunTable::number(std::size_t row, std::string_view name) const
{
  const std::string& cell = text(row, name);
  const auto value = parsed<double>(cell);
  if (!value)
    throw std::runtime_error(
        "'" + path_ + "', row " + std::to_string(row + 1) + ", " + std::string(name) + ": '" +
        cell + "' is no number");
  return *value;
}

Vec3 RunTable::vector(std::size_t row, const std::array<std::string_view, 3>& names) const
{
  return {number(row, names[0]), number(row, names[1]), number(row, names[2])};
}

}  // namespace fastlio
