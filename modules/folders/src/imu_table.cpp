// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "imu_columns.h"
#include "stamp_text.h"
#include "timed_stream.h"
#include <fastlio/files/bounded_line.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/recordings/sensor_imu.h>

#include <algorithm>
#include <stdexcept>

namespace fastlio
{
ImuTable::ImuTable(const std::string& path) : path_(path), in_(path, std::ios::binary)
{
  std::string line;
  if (!in_ || !readBoundedLine(in_, line))
    throw std::runtime_error("'" + path + "' cannot be read, or is empty");
  bytes_ += line.size() + 1;
  findUnit(readNames(line));
  if (parseLine(line)) return;  // the first line was a sample
  advance();
}

std::int64_t ImuTable::readNames(const std::string& line)
{
  columns_ = {0, 1, 2, 3, 4, 5, 6};
  factors_.assign(columns_.size(), 1.0);
  if (parseLine(line)) return 0;
  const std::size_t begin = line.find_first_not_of("# ");
  const auto names = cellsOf(std::string_view(line).substr(std::min(begin, line.size())));
  std::vector<std::optional<std::size_t>> found(columns_.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const int role = roleOfColumn(names[i]);
    if (role >= 0 && !found[static_cast<std::size_t>(role)])
      found[static_cast<std::size_t>(role)] = i;
  }
  for (std::size_t role = 0; role < found.size(); ++role)
  {
    if (!found[role])
      throw std::runtime_error(
          "'" + path_ +
          "': its first line is neither a sample (time, wx, wy, wz, ax, ay, az) nor "
          "names columns for all of these: '" +
          printable(line) + "'");
    columns_[role] = *found[role];
    if (role > 0) factors_[role] = siFactorOfColumn(names[columns_[role]]);
  }
  const std::int64_t unit_ns = timeUnitOfColumn(names[columns_[0]]);
  // The rest of each second stands in a column of its own.
  if (unit_ns == kSecondNs)
    for (std::size_t i = 0; i < names.size(); ++i)
      if (isNanosecondColumn(names[i])) nanoseconds_ = i;
  return unit_ns;
}

/** The times of the first samples. */
std::vector<std::string> ImuTable::firstTimes()
{
  constexpr std::size_t kLooks = 1000;
  std::vector<std::string> times;
  std::ifstream in(path_, std::ios::binary);
  for (std::string line; times.size() < kLooks && readBoundedLine(in, line);)
    if (parseLine(line)) times.emplace_back(cellsOf(line)[columns_[0]]);
  return times;
}

// What the name says holds, unless the numbers cannot be times in that unit.
void ImuTable::findUnit(std::int64_t named_ns)
{
  const std::vector<std::string> times = firstTimes();
  const auto fits = [&](const std::string& time) { return stampOf(time, named_ns).has_value(); };
  const bool holds = named_ns > 0 && std::all_of(times.begin(), times.end(), fits);
  unit_ns_ = holds ? named_ns : stampUnitOf(times, kSampleRhythm);
  stamp_ns_.reset();
}

bool ImuTable::parseLine(std::string_view line)
{
  const auto cells = cellsOf(line);
  const auto cell = [&](std::size_t column)
  { return column < cells.size() ? cells[column] : std::string_view(); };
  auto stamp_ns = stampOf(cell(columns_[0]), unit_ns_);
  if (stamp_ns && nanoseconds_)
  {
    const auto rest_ns = parsed<std::int64_t>(cell(*nanoseconds_));
    if (!rest_ns || *rest_ns < 0 || *rest_ns >= kSecondNs) return false;
    *stamp_ns += *rest_ns;
  }
  std::vector<double> values;
  for (std::size_t role = 1; role < columns_.size(); ++role)
    if (const auto value = parsed<double>(cell(columns_[role])))
      values.push_back(factors_[role] * *value);
  if (!stamp_ns || values.size() != columns_.size() - 1) return false;
  stamp_ns_ = stamp_ns;
  values_ = std::move(values);
  return true;
}

// To the next line that is a sample.
void ImuTable::advance()
{
  stamp_ns_.reset();
  for (std::string line; !stamp_ns_ && readBoundedLine(in_, line);)
  {
    bytes_ += line.size() + 1;
    if (line.empty() || line.front() == '#') continue;
    if (!parseLine(line)) ++bad_;
  }
}

std::optional<std::int64_t> ImuTable::stamp() const
{
  if (stamp_ns_) return stamp_ns_;
  // The problem is reported at the end, when it is known how many lines it is about.
  return bad_ > 0 && !told_ ? std::optional<std::int64_t>(INT64_MAX) : std::nullopt;
}

NextRecorded ImuTable::take()
{
  if (!stamp_ns_)
  {
    told_ = true;
    return fileProblem(path_, "has " + std::to_string(bad_) + " lines that are no samples");
  }
  auto imu = makeImu(
      "imu", *stamp_ns_, Vec3(values_[0], values_[1], values_[2]),
      Vec3(values_[3], values_[4], values_[5]));
  ++taken_;
  advance();
  return mrpt::obs::CObservation::Ptr(imu);
}

TopicReport ImuTable::report() const
{
  const bool converted =
      std::any_of(factors_.begin(), factors_.end(), [](double factor) { return factor != 1.0; });
  return {
      "imu", "table", taken_ + bad_, taken_,
      converted ? "IMU, converted from the units that the columns name" : "IMU, units as recorded"};
}

}  // namespace fastlio
