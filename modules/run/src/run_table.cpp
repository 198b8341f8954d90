// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/bounded_line.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/run/run_table.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

namespace fastlio
{
namespace
{
/** Calls \a take for each cell of a line. */
template <typename Take>
void forEachCell(std::string_view line, Take take)
{
  for (std::size_t begin = 0;;)
  {
    const std::size_t end = line.find(',', begin);
    take(line.substr(begin, end - begin));
    if (end == std::string_view::npos) return;
    begin = end + 1;
  }
}
}  // namespace

RunTable::RunTable(const std::string& path) : path_(path)
{
  std::ifstream in(path, std::ios::binary);
  std::size_t number = 0;
  for (std::string line; readBoundedLine(in, line);)
  {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    if (names_.empty())
      forEachCell(line, [this](std::string_view cell) { names_.emplace_back(cell); });
    else
      add(line, number);
  }
  if (names_.empty()) throw std::runtime_error("'" + path + "' cannot be read, or is no table");
}

void RunTable::add(std::string_view line, std::size_t number)
{
  if (cells_.size() + line.size() > kMostBytes) fail(number, "the table is larger than 2 GiB");
  std::size_t cells = 0;
  forEachCell(
      line,
      [&](std::string_view cell)
      {
        cells_ += cell;
        ends_.push_back(cells_.size());
        ++cells;
      });
  if (cells != names_.size())
    fail(number, std::to_string(cells) + " columns instead of " + std::to_string(names_.size()));
  lines_.push_back(number);
}

void RunTable::fail(std::size_t line, const std::string& what) const
{
  throw std::runtime_error("'" + path_ + "', line " + std::to_string(line) + ": " + what);
}

bool RunTable::has(std::string_view name) const
{
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t RunTable::column(std::string_view name) const
{
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end())
    throw std::runtime_error("'" + path_ + "' has no column '" + std::string(name) + "'");
  return static_cast<std::size_t>(found - names_.begin());
}

std::string_view RunTable::text(std::size_t row, std::string_view name) const
{
  const std::size_t cell = row * names_.size() + column(name);
  const std::size_t begin = cell == 0 ? 0 : ends_.at(cell - 1);
  return std::string_view(cells_).substr(begin, ends_.at(cell) - begin);
}

double RunTable::number(std::size_t row, std::string_view name) const
{
  const std::string_view cell = text(row, name);
  if (const auto value = parsed<double>(cell)) return *value;
  fail(lines_.at(row), std::string(name) + ": '" + printable(std::string(cell)) + "' is no number");
}

std::int64_t RunTable::stamp(std::size_t row, std::string_view name) const
{
  const std::string_view cell = text(row, name);
  if (const auto value = parsed<std::int64_t>(cell)) return *value;
  fail(
      lines_.at(row),
      std::string(name) + ": '" + printable(std::string(cell)) + "' is no stamp in nanoseconds");
}

Vec3 RunTable::vector(std::size_t row, const std::array<std::string_view, 3>& names) const
{
  return {number(row, names[0]), number(row, names[1]), number(row, names[2])};
}

}  // namespace fastlio
