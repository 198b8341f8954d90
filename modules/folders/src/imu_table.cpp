// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "stamp_text.h"
#include "timed_stream.h"
#include <fastlio/files/bounded_line.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/recordings/sensor_imu.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace fastlio
{
namespace
{
/** Parts between commas, or semicolons, or else blanks; without the blanks around them. */
std::vector<std::string_view> cellsOf(std::string_view line)
{
  constexpr std::string_view kAround = " \t\r";
  const std::string_view separators = line.find(',') != std::string_view::npos   ? ","
                                      : line.find(';') != std::string_view::npos ? ";"
                                                                                 : kAround;
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();)
  {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    cell.remove_prefix(std::min(cell.find_first_not_of(kAround), cell.size()));
    cell = cell.substr(0, cell.find_last_not_of(kAround) + 1);
    if (!cell.empty() || separators != kAround) cells.push_back(cell);
    begin = end + 1;
  }
  return cells;
}

/** Small letters and digits. */
std::string plainText(std::string_view text)
{
  std::string plain;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

/** Without the unit: "Angular_Velocity.x [rad/s]" is "angularvelocityx". */
std::string plainName(std::string_view name)
{
  return plainText(name.substr(0, name.find_first_of("[(")));
}

/** A word and what it says of times [ns]; 0: nothing. */
struct TimeWord
{
  const char* word;
  std::int64_t unit_ns;
};

constexpr std::int64_t kMicrosecond = 1000, kMillisecond = 1'000'000;
constexpr std::array<TimeWord, 18> kTimeColumns{{
    {"t", 0},
    {"time", 0},
    {"timestamp", 0},
    {"stamp", 0},
    {"times", 0},
    {"timens", 1},
    {"timestampns", 1},
    {"stampns", 1},
    {"timeus", kMicrosecond},
    {"timestampus", kMicrosecond},
    {"timems", kMillisecond},
    {"timestampms", kMillisecond},
    {"sec", kSecondNs},
    {"secs", kSecondNs},
    {"seconds", kSecondNs},
    {"headerstampsec", kSecondNs},
    {"headerstampsecs", kSecondNs},
    {"timesec", kSecondNs},
}};
constexpr std::array<const char*, 7> kNanosecondColumns{"nsec",
                                                        "nsecs",
                                                        "nanosec",
                                                        "nanosecs",
                                                        "nanoseconds",
                                                        "headerstampnsecs",
                                                        "headerstampnanosec"};
constexpr std::array<TimeWord, 13> kUnitWords{{
    {"ns", 1},
    {"nsec", 1},
    {"nanosec", 1},
    {"nanoseconds", 1},
    {"us", kMicrosecond},
    {"usec", kMicrosecond},
    {"microseconds", kMicrosecond},
    {"ms", kMillisecond},
    {"msec", kMillisecond},
    {"milliseconds", kMillisecond},
    {"s", kSecondNs},
    {"sec", kSecondNs},
    {"seconds", kSecondNs},
}};

template <std::size_t Count>
const TimeWord* wordIn(const std::array<TimeWord, Count>& words, const std::string& word)
{
  const auto found = std::find_if(
      words.begin(), words.end(), [&](const TimeWord& row) { return word == row.word; });
  return found == words.end() ? nullptr : &*found;
}

/** The unit that the name of a column of times gives [ns]: "timestamp [ns]", "time_us"; 0: none. */
std::int64_t unitIn(std::string_view name)
{
  const std::size_t bracket = name.find_first_of("[(");
  if (bracket != std::string_view::npos)
  {
    const std::string_view text = name.substr(bracket + 1, name.find_first_of("])") - bracket - 1);
    // The letter mu is none of ASCII's.
    if (std::any_of(
            text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }))
      return kMicrosecond;
    const TimeWord* unit = wordIn(kUnitWords, plainText(text));
    if (unit != nullptr) return unit->unit_ns;
  }
  const TimeWord* column = wordIn(kTimeColumns, plainName(name));
  return column == nullptr ? 0 : column->unit_ns;
}

/** 0: time, 1 to 3: rates, 4 to 6: accelerations; -1: something else. */
int roleOf(const std::string& name)
{
  if (wordIn(kTimeColumns, name) != nullptr) return 0;
  const auto starts = [&](const char* with) { return name.rfind(with, 0) == 0; };
  const int axis = name.empty() ? 0 : name.back() - 'x' + 1;
  if (axis < 1 || axis > 3) return -1;
  if (starts("w") || starts("gyr") || starts("angular") || starts("omega") || starts("rate"))
    return axis;
  if (starts("a") || starts("linearacc")) return 3 + axis;
  return -1;
}
}  // namespace

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
  if (parseLine(line)) return 0;
  const std::size_t begin = line.find_first_not_of("# ");
  const auto names = cellsOf(std::string_view(line).substr(std::min(begin, line.size())));
  std::vector<std::optional<std::size_t>> found(columns_.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const int role = roleOf(plainName(names[i]));
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
  }
  const std::int64_t unit_ns = unitIn(names[columns_[0]]);
  // The rest of each second stands in a column of its own.
  if (unit_ns == kSecondNs)
    for (std::size_t i = 0; i < names.size(); ++i)
      for (const char* nanoseconds : kNanosecondColumns)
        if (plainName(names[i]) == nanoseconds) nanoseconds_ = i;
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
    if (const auto value = parsed<double>(cell(columns_[role]))) values.push_back(*value);
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
  return {"imu", "table", taken_ + bad_, taken_, "IMU, units as recorded"};
}

}  // namespace fastlio
