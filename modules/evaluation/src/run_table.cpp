// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "text_numbers.h"
#include <fastlio/evaluation/run_table.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
RunTable::RunTable(std::filesystem::path file) : file_(std::move(file))
{
  const std::vector<DataLine> lines = readDataLines(file_);
  header_line_ = lines.front().number;
  for (const std::string_view name : splitAtCommas(lines.front().text))
    names_.emplace_back(name);
  for (auto line = lines.begin() + 1; line != lines.end(); ++line)
    add(line->text, line->number);
}

void RunTable::add(std::string_view text, std::size_t line)
{
  const std::vector<std::string_view> cells = splitAtCommas(text);
  if (cells.size() != names_.size())
    failAt(
        {file_, line}, "expected " + std::to_string(names_.size()) +
                           " comma-separated columns as in the header, saw " +
                           std::to_string(cells.size()));
  for (const std::string_view cell : cells)
  {
    cells_ += cell;
    ends_.push_back(cells_.size());
  }
  lines_.push_back(line);
}

std::size_t RunTable::placeOf(std::string_view name) const
{
  const auto found = std::find(names_.begin(), names_.end(), name);
  return static_cast<std::size_t>(found - names_.begin());
}

bool RunTable::has(std::string_view name) const
{
  return placeOf(name) < names_.size();
}

std::vector<std::size_t> RunTable::columns(const std::vector<std::string>& names) const
{
  std::vector<std::size_t> places;
  std::vector<std::string> missing;
  for (const std::string& name : names)
  {
    places.push_back(placeOf(name));
    if (places.back() == names_.size()) missing.push_back(name);
  }
  if (!missing.empty())
    failAt(
        {file_, header_line_}, "the header line lacks the columns " + joined(missing) +
                                   "; expected the header of a file that fastlio-replay wrote");
  return places;
}

std::string_view RunTable::text(std::size_t row, std::size_t column) const
{
  const std::size_t cell = row * names_.size() + column;
  const std::size_t begin = cell == 0 ? 0 : ends_.at(cell - 1);
  return std::string_view(cells_).substr(begin, ends_.at(cell) - begin);
}

std::string_view RunTable::text(std::size_t row, std::string_view name) const
{
  const std::size_t place = placeOf(name);
  return text(row, place < names_.size() ? place : columns({std::string(name)}).front());
}

double RunTable::number(std::size_t row, std::string_view name) const
{
  const std::string_view cell = text(row, name);
  if (const auto value = parsed<double>(cell)) return *value;
  failAt({file_, line(row)}, std::string(name) + ": '" + printable(cell) + "' is no number");
}

std::int64_t RunTable::stamp(std::size_t row, std::string_view name) const
{
  return parseNanoseconds(text(row, name), {file_, line(row)});
}

Vec3 RunTable::vector(std::size_t row, const std::array<std::string_view, 3>& names) const
{
  return {number(row, names[0]), number(row, names[1]), number(row, names[2])};
}

}  // namespace fastlio
